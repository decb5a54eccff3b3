// A frame of a crowd: its blocks, their stages, and packing.
#pragma once

#include "crowd_state.h"
#include "gpu_rig_reader.h"
#include "half_scale.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <new>

namespace rigel {

template <int B>
struct Crowd<B>::State {
  using Block = crowd::Block;
  using Character = crowd::Character;
  using NearSlot = crowd::NearSlot;
  using Population = crowd::Population;
  using StageClock = crowd::StageClock;
  using Task = crowd::Task;
  static constexpr int kBlock = crowd::kBlock;
  static constexpr int kWidth = 3 * shCount(B);
  static constexpr int kPadded = 4 * gpuVectorSize(B);

  explicit State(int count) : tasks(static_cast<std::size_t>(std::max(count, 1))) {}

  CrowdStats frame(const CrowdLights& frameLights, float seconds, const CrowdOutput& to, ParallelFor parallel,
                   CrowdProbe clock);
  void reserve(Task& task);
  void runBlocks(int first) noexcept;
  void tryUpdate(Task& task, const Block& block) noexcept;
  void update(Task& task, const Block& block);
  void show(Task& task, const Block& block) noexcept;

  // Stages of `update`, for n characters.
  void fetchAhead(Task& task, const Block& block, const Block* after) noexcept;
  static const JointMatrix* paletteOf(const Population& population, const Character& character) noexcept;
  void pose(Task& task, const Block& block, Population& population) noexcept;
  void maskLights(Task& task, int n) noexcept;
  void weighNear(Task& task, const Block& block, Population& population);
  void weigh(Task& task, const Block& block, Population& population);
  void project(Task& task, const Population& population, int n);
  void placeResults(Task& task, const Block& block, Population& population) noexcept;
  void keep(Task& task, const Block& block, Population& population) noexcept;

  void showBetween(Task& task, Population& population, std::size_t index) noexcept;
  void pack(Population& population, std::size_t index, const float* coefficients, const float* place) noexcept;
  int packNear(const Character& character, std::span<const NearSlot> slots) noexcept;

  Character& at(Population& population, const Block& block, int i) noexcept {
    return population.characters[schedule.character(block.begin + static_cast<std::uint32_t>(i))];
  }

  std::vector<Population> populations;
  std::vector<Task> tasks;
  crowd::FrameLights lights;
  crowd::Schedule schedule;
  std::uint64_t frames = 0;
  int alive = 0;

  // Of the frame.
  CrowdOutput output;
  CrowdProbe probe;
  int parts = 0;  // tasks that have blocks
};

// Blocks of a frame.

template <int B>
CrowdStats Crowd<B>::State::frame(const CrowdLights& frameLights, float seconds, const CrowdOutput& to,
                                  ParallelFor parallel, CrowdProbe clock) {
  assert(frameLights.lights != nullptr && frameLights.prepared != nullptr);
  const bool cut = !(seconds > 0 && std::isfinite(seconds));
  lights.set(frameLights);
  for (Task& task : tasks) reserve(task);
  if (lights.hasTree()) schedule.reservePlaces();
  CrowdStats stats =
      schedule.plan(populations, frames++, cut ? 0 : seconds, cut, lights.hasTree() ? lights.tree().cell : 0);
  assert(to.rigs.size() >= static_cast<std::size_t>(stats.visible));
  output = to;
  probe = clock;
  const ParallelFor::Task run = [](void* work, int i) { static_cast<State*>(work)->runBlocks(i); };
  const std::size_t blocks = schedule.blocks().size();
  parts = parallel.run != nullptr ? static_cast<int>(std::min(tasks.size(), blocks)) : 1;
  for (std::size_t i = 0, n = static_cast<std::size_t>(parts); i < n; ++i)
    tasks[i].blocks.set(i * blocks / n, (i + 1) * blocks / n);
  if (parts > 1) {
    parallel.run(parallel.context, parts, run, this);
  } else if (parts > 0) {
    run(this, 0);
  }
  bool exhausted = false;
  if (!lights.hasTree()) stats.lights = static_cast<std::uint64_t>(stats.updated) * lights.ids().size();
  for (const Task& task : tasks) {
    stats.unusable += task.stats.unusable;
    stats.lights += task.stats.lights;
    stats.clusters += task.stats.clusters;
    stats.merged = std::max(stats.merged, task.stats.merged);
    stats.asked += lights.hasTree() ? task.tree.asked() : 0;
    for (std::size_t i = 0; i < stats.ticks.size(); ++i) stats.ticks[i] += task.stats.ticks[i];
    exhausted = exhausted || task.exhausted;
  }
  if (exhausted) throw std::bad_alloc();
  return stats;
}

/// For the frame's lights.
template <int B>
void Crowd<B>::State::reserve(Task& task) {
  for (const Population& population : populations) {
    const CrowdKind::Data& kind = population.data();
    task.reserve(kind, kWidth, kPadded, lights.hasTree() ? 0 : lights.count());
    if (!lights.hasTree()) continue;
    const auto uses = static_cast<std::size_t>(lights.prepared().size());
    task.tree.reserve(kind.samples, kWidth, uses);
    task.errors.reserve(std::min(uses, crowd::TreeTask::kListed) * kBlock);
  }
  if (lights.hasTree()) task.tree.begin(lights);
  task.stats = {};
  task.exhausted = false;
}

/// A task's own part, which it had in the last frame too and has in its caches, then what is left of the others'.
template <int B>
void Crowd<B>::State::runBlocks(int first) noexcept {
  Task& task = tasks[static_cast<std::size_t>(first)];
  const std::span<const Block> blocks = schedule.blocks();
  for (int k = 0; k < parts; ++k) {
    crowd::BlockQueue& queue = tasks[static_cast<std::size_t>((first + k) % parts)].blocks;
    for (std::size_t i; (i = queue.take()) != queue.kNone;) {
      const std::size_t after = queue.following();
      fetchAhead(task, blocks[i], after != queue.kNone ? &blocks[after] : nullptr);
      blocks[i].update ? tryUpdate(task, blocks[i]) : show(task, blocks[i]);
    }
  }
}

// Updates.

/// No exception crosses the caller's threads: `frame` throws it.
template <int B>
void Crowd<B>::State::tryUpdate(Task& task, const Block& block) noexcept {
  try {
    update(task, block);
  } catch (const std::bad_alloc&) {
    task.exhausted = true;
    for (int c = 0; c < static_cast<int>(block.count); ++c) at(populations[block.population], block, c).lit = false;
  }
}

template <int B>
void Crowd<B>::State::update(Task& task, const Block& block) {
  Population& population = populations[block.population];
  const CrowdKind::Data& kind = population.data();
  const int n = static_cast<int>(block.count);
  StageClock clock(probe, task.stats);
  pose(task, block, population);
  clock.done(CrowdStage::pose);
  if (kind.skinned()) {
    crowd::refreshOperators(n, kind.monomials(), kind.shares, task.positions.data(), task.places, task.normal.data(),
                            task.op.data());
    clock.done(CrowdStage::refresh);
  }
  if (lights.hasTree()) {
    task.tree.template select<B>(lights, task.places, task.groups, n, task.stats);
    clock.done(CrowdStage::select);
  }
  weigh(task, block, population);
  clock.done(CrowdStage::rank);
  project(task, population, n);
  clock.done(CrowdStage::project);
  const float* op = kind.skinned() ? task.op.data() : kind.restOperator.data();
  crowd::fitBlock(
      {n, kind.samples, kind.vectors, kWidth, kPadded, op, !kind.skinned(), task.sums.data(), static_cast<float>(kPi)},
      task.rows.data());
  placeResults(task, block, population);
  crowd::transposeRows(task.rows.data(), kind.vectors * kPadded, n, task.coefficientsOf);
  clock.done(CrowdStage::fit);
  keep(task, block, population);
  clock.done(CrowdStage::pack);
}

/// Where this block's results go and what the next one, if there is one, begins with.
template <int B>
void Crowd<B>::State::fetchAhead(Task& task, const Block& block, const Block* after) noexcept {
  task.ahead.clear();
  if (!block.update) return;
  Population& population = populations[block.population];
  for (int c = 0; c < static_cast<int>(block.count); ++c) {
    const Character& character = at(population, block, c);
    if (!output.coefficients.empty())
      task.ahead.add(&output.coefficients[character.offset], population.floats() * sizeof(float));
    task.ahead.add(&output.rigs[static_cast<std::size_t>(character.result.rig)], sizeof(GpuRig));
    if (population.nearSlots() > 0)
      task.ahead.add(&output.nearLights[static_cast<std::size_t>(character.result.nearOffset)],
                     population.nearSlots() * sizeof(GpuNearLight));
  }
  if (after == nullptr || !after->update) return;
  Population& nextPopulation = populations[after->population];
  const CrowdKind::Data& kind = nextPopulation.data();
  for (int c = 0; c < static_cast<int>(after->count); ++c) {
    const JointMatrix* palette = paletteOf(nextPopulation, at(nextPopulation, *after, c));
    task.ahead.add(palette, kind.jointLines.of(palette));
  }
  // Those behind the next block, whose palettes will be asked for then.
  const std::uint32_t begin = after->begin + after->count;
  const std::uint32_t end = std::min(begin + static_cast<std::uint32_t>(kBlock), schedule.size());
  for (std::uint32_t i = begin; i < end; ++i) {
    const std::size_t index = schedule.character(i);
    if (index < nextPopulation.characters.size())
      task.ahead.add(&nextPopulation.characters[index], offsetof(Character, from));
  }
}

/// The character's, or one at rest where it has not all joints.
template <int B>
const JointMatrix* Crowd<B>::State::paletteOf(const Population& population, const Character& character) noexcept {
  const CrowdKind::Data& kind = population.data();
  const std::span<const JointMatrix> palette = character.input.palette;
  return palette.size() >= static_cast<std::size_t>(kind.joints) ? palette.data() : kind.restPalette.data();
}

template <int B>
void Crowd<B>::State::pose(Task& task, const Block& block, Population& population) noexcept {
  const CrowdKind::Data& kind = population.data();
  const int n = static_cast<int>(block.count);
  const JointMatrix* palettes[kBlock];
  for (int c = 0; c < kBlock; ++c) {
    // Lanes without a character do what the last one's does.
    Character& character = at(population, block, std::min(c, n - 1));
    const RigFrame& f = character.input.worldFromRig;
    const Vec3 columns[4] = {f.x, f.y, f.z, f.origin};
    for (int i = 0; i < 12; ++i) task.places.frame[i][c] = columns[i / 3][i % 3];
    task.groups[c] = character.input.groups;
    palettes[c] = paletteOf(population, character);
  }
  const float* positions = kind.restPositions.data();
  if (kind.skinned()) {
    crowd::skinAnchors(kind.skin(), std::span<const JointMatrix* const, kBlock>(palettes), n, task.positions.data());
    positions = task.positions.data();
  }
  for (int a = 0; a < 3; ++a) {
    std::fill_n(task.places.lo[a], kBlock, kind.rig.box().lo[a]);
    std::fill_n(task.places.hi[a], kBlock, kind.rig.box().hi[a]);
  }
  crowd::placeAnchors(n, kind.footprints, kind.shares, positions, kind.skinned(), task.places, task.x.data(),
                      task.y.data(), task.z.data());
  for (int c = 0; c < n; ++c) {
    Character& character = at(population, block, c);
    const bool complete = character.input.palette.size() >= static_cast<std::size_t>(kind.joints);
    character.usable = complete && task.places.finite[c] == 0;
    if (!character.usable) ++task.stats.unusable;
  }
}

/// Near weights of the block, and what they leave to its rigs.
template <int B>
void Crowd<B>::State::weigh(Task& task, const Block& block, Population& population) {
  const CrowdKindOptions& options = population.data().options;
  const int n = static_cast<int>(block.count);
  lights.hasTree() ? task.tree.clearNear() : task.shares.clear(block.count);
  if (options.nearSlots > 0) weighNear(task, block, population);
  if (lights.hasTree()) return;
  // Last: what is masked is so for the rig at once, while what is near of it fades.
  maskLights(task, n);
}

template <int B>
void Crowd<B>::State::weighNear(Task& task, const Block& block, Population& population) {
  const CrowdKindOptions& options = population.data().options;
  const int n = static_cast<int>(block.count);
  const bool tree = lights.hasTree();
  const crowd::RankRows ranks = tree ? task.tree.rank(lights) : lights.ranks();
  task.errors.reserve(static_cast<std::size_t>(ranks.count) * kBlock);
  float* errors = task.errors.data();
  crowd::rankLights(ranks, {&task.places, task.groups, n, population.data().degree}, errors);
  if (tree) task.tree.share(errors);
  crowd::nthLargest(errors, ranks.count, n, options.nearSlots + 1, task.floors);
  for (int c = 0; c < n; ++c) task.floors[c] = std::max(task.floors[c], options.tolerance);
  crowd::findAbove(errors, ranks.count, n, task.floors, options.nearSlots, task.hits);
  crowd::NearView view;
  view.ids = lights.ids();
  view.fresh = lights.fresh();
  for (int c = 0; c < n; ++c) {
    const std::size_t index = schedule.character(block.begin + static_cast<std::uint32_t>(c));
    const Character& character = population.characters[index];
    view.errors = errors + c;
    view.above = {task.hits.light[c], static_cast<std::size_t>(task.hits.count[c])};
    view.floor = task.floors[c];
    if (tree) {
      view.listed = task.tree.listed();
      view.shares = task.tree.shares() + c;
      view.lights = &lights.lights();
      view.groups = task.groups[c];
    }
    view.step = options.weightRate > 0 ? std::min(options.weightRate * character.seconds, 1.0f) : 1;
    view.cut = !character.lit;
    view.atOnce = character.span == 1;
    crowd::updateNear(view, population.nearOf(index));
    if (tree) {
      task.tree.setNear(c, population.nearOf(index));
      continue;
    }
    for (const NearSlot& slot : population.nearOf(index))
      if (slot.to > 0) task.shares.set(slot.light, static_cast<std::size_t>(c), 1 - slot.to);
  }
}

/// Lights of other groups than a character's.
template <int B>
void Crowd<B>::State::maskLights(Task& task, int n) noexcept {
  for (int c = 0; c < n; ++c) {
    if (!lights.grouped() && task.groups[c] != 0) continue;
    for (int i = 0; i < lights.count(); ++i)
      if ((lights.ranks().groups[i] & task.groups[c]) == 0) task.shares.set(i, static_cast<std::size_t>(c), 0);
  }
}

template <int B>
void Crowd<B>::State::project(Task& task, const Population& population, int n) {
  const CrowdKind::Data& kind = population.data();
  const std::size_t count = static_cast<std::size_t>(n), points = count * static_cast<std::size_t>(kind.samples);
  for (std::size_t s = 0; s < kind.footprints.size(); ++s)
    std::fill_n(task.footprints.data() + s * count, count, kind.footprints[s]);
  const Vec3Rows rows{{task.x.data(), points}, {task.y.data(), points}, {task.z.data(), points}};
  const std::span<const float> footprints(task.footprints.data(), points);
  const std::span<float> sums(task.sums.data(), kWidth * points);
  if (lights.hasTree()) return task.tree.template project<B>(lights, rows, footprints, n, sums, task.ahead.view());
  projectBatch<B>(lights.prepared(), lights.uses(), rows, footprints, sums, task.shares.view(lights.uses().size()),
                  task.ahead.view());
}

/// Where coefficients go: to the output at once, where that is all that becomes of them.
template <int B>
void Crowd<B>::State::placeResults(Task& task, const Block& block, Population& population) noexcept {
  const bool direct = !output.coefficients.empty() && output.halves.empty();
  for (int c = 0; c < static_cast<int>(block.count); ++c) {
    const Character& character = at(population, block, c);
    float* own = task.coefficients.data() + static_cast<std::size_t>(c) * population.floats();
    const bool shown = direct && character.usable && character.span == 1;
    task.coefficientsOf[c] = shown ? &output.coefficients[character.offset].x : own;
  }
}

/// Results for characters that are not updated in every frame, and packing.
template <int B>
void Crowd<B>::State::keep(Task& task, const Block& block, Population& population) noexcept {
  float* places[kBlock];
  for (int c = 0; c < kBlock; ++c) places[c] = task.rigPlaces[c];
  crowd::placeBoxes(static_cast<int>(block.count), task.places, task.placeRows);
  crowd::transposeRows(task.placeRows, crowd::kPlaceRows, static_cast<int>(block.count), places);
  const std::size_t floats = population.floats();
  for (std::size_t c = 0; c < block.count; ++c) {
    const std::size_t index = schedule.character(block.begin + static_cast<std::uint32_t>(c));
    Character& character = population.characters[index];
    const float* latest = task.coefficientsOf[c];
    const bool goesOn = character.lit && character.kept;
    character.seconds = 0;
    character.lit = character.usable;
    character.kept = character.span > 1;
    if (character.span == 1) {
      pack(population, index, latest, task.rigPlaces[c]);
      continue;
    }
    // What was shown in every frame was not kept: it is what comes out now.
    const auto at = [&](const float(&row)[3][kBlock]) { return Vec3{row[0][c], row[1][c], row[2][c]}; };
    const RigBox box{at(task.places.lo), at(task.places.hi)};
    character.from = goesOn ? character.to : box;
    character.to = box;
    float* to = population.toOf(index);
    std::copy_n(goesOn ? to : latest, floats, population.fromOf(index));
    std::copy_n(latest, floats, to);
    showBetween(task, population, index);
  }
}

template <int B>
void Crowd<B>::State::show(Task& task, const Block& block) noexcept {
  Population& population = populations[block.population];
  StageClock clock(probe, task.stats);
  for (std::uint32_t c = 0; c < block.count; ++c) showBetween(task, population, schedule.character(block.begin + c));
  clock.done(CrowdStage::pack);
}

// Packing.

/// A character as it is between the results that are kept.
template <int B>
void Crowd<B>::State::showBetween(Task& task, Population& population, std::size_t index) noexcept {
  const Character& character = population.characters[index];
  const float t = character.shown();
  const auto mix = [t](Vec3 a, Vec3 b) { return a + (b - a) * t; };
  const RigBox box{mix(character.from.lo, character.to.lo), mix(character.from.hi, character.to.hi)};
  GpuRig place{};
  placeRigBox(box, character.input.worldFromRig, place);
  const float numbers[crowd::kPlaceRows] = {place.centre.x, place.centre.y, place.centre.z, 0,
                                            place.axisX.x,  place.axisX.y,  place.axisX.z,  place.axisX.w,
                                            place.axisY.x,  place.axisY.y,  place.axisY.z,  place.axisY.w,
                                            place.axisZ.x,  place.axisZ.y,  place.axisZ.z,  place.axisZ.w};
  crowd::blend(population.fromOf(index), population.toOf(index), t, population.floats(), task.shown.data());
  pack(population, index, task.shown.data(), numbers);
}

/// `place`: as placeBoxes gives it.
template <int B>
void Crowd<B>::State::pack(Population& population, std::size_t index, const float* coefficients,
                           const float* place) noexcept {
  Character& character = population.characters[index];
  const std::size_t floats = population.floats(), offset = character.offset;
  // In place: a copy would be read in larger pieces than it was written, which a core waits for.
  GpuRig& rig = output.rigs[static_cast<std::size_t>(character.result.rig)];
  rig = population.data().description;
  rig.offset = static_cast<int>(offset);
  rig.highOffset = static_cast<int>(offset + floats / 4);
  if (!character.usable) {
    rig.vectors = 0;
    return;
  }
  rig.centre = {place[0], place[1], place[2]};
  rig.axisX = {place[4], place[5], place[6], place[7]};
  rig.axisY = {place[8], place[9], place[10], place[11]};
  rig.axisZ = {place[12], place[13], place[14], place[15]};
  if (!output.coefficients.empty()) {
    float* to = &output.coefficients[offset].x;
    if (to != coefficients) std::copy_n(coefficients, floats, to);
  }
  if (!output.halves.empty()) {
    const float scale = halfScale(static_cast<double>(crowd::largestOf(coefficients, floats)));
    rig.scale = scale;
    crowd::storeHalves(coefficients, 1 / scale, floats, &output.halves[offset]);
  }
  character.result.nearCount = packNear(character, population.nearOf(index));
}

template <int B>
int Crowd<B>::State::packNear(const Character& character, std::span<const NearSlot> slots) noexcept {
  int count = 0;
  for (const NearSlot& slot : slots) {
    if (slot.light < 0) continue;
    const float weight = slot.from + (slot.to - slot.from) * character.shown();
    const int light = crowd::findLight(lights.ids(), slot.id, slot.light);
    if (light < 0 || !(weight > 0)) continue;
    const GpuNearLight& near = lights.near(light);
    GpuNearLight& out = output.nearLights[static_cast<std::size_t>(character.result.nearOffset + count++)];
    out = near;
    out.colour = {near.colour.x * weight, near.colour.y * weight, near.colour.z * weight};
  }
  return count;
}

}  // namespace rigel
