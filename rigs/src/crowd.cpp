#include <rigel/crowd.h>

#include "crowd_frame.h"

namespace rigel {

template <int B>
Crowd<B>::Crowd(int tasks) : state_(std::make_unique<State>(tasks)) {}
template <int B>
Crowd<B>::Crowd(Crowd&&) noexcept = default;
template <int B>
Crowd<B>& Crowd<B>::operator=(Crowd&&) noexcept = default;
template <int B>
Crowd<B>::~Crowd() = default;

template <int B>
int Crowd<B>::addKind(std::shared_ptr<const CrowdKind> kind) {
  crowd::Population population;
  population.kind = std::move(kind);
  population.padded = State::kPadded;
  for (crowd::Task& task : state_->tasks) task.reserve(population.data(), State::kWidth, State::kPadded, 0);
  state_->populations.push_back(std::move(population));
  return static_cast<int>(state_->populations.size()) - 1;
}

template <int B>
CrowdId Crowd<B>::add(int kind) {
  crowd::Population& population = state_->populations[static_cast<std::size_t>(kind)];
  if (population.free.empty()) population.grow();
  state_->schedule.reserve(state_->populations);
  const std::uint32_t index = population.take();
  ++state_->alive;
  return {static_cast<std::uint32_t>(kind), index, population.characters[index].generation};
}

template <int B>
void Crowd<B>::remove(CrowdId id) noexcept {
  assert(contains(id));
  state_->populations[id.kind].remove(id.index);
  --state_->alive;
}

template <int B>
int Crowd<B>::size() const noexcept {
  return state_->alive;
}

template <int B>
bool Crowd<B>::contains(CrowdId id) const noexcept {
  if (id.kind >= state_->populations.size()) return false;
  const auto& characters = state_->populations[id.kind].characters;
  return id.index < characters.size() && characters[id.index].alive && characters[id.index].generation == id.generation;
}

template <int B>
CrowdInput& Crowd<B>::input(CrowdId id) noexcept {
  assert(contains(id));
  return state_->populations[id.kind].characters[id.index].input;
}

template <int B>
CrowdResult Crowd<B>::result(CrowdId id) const noexcept {
  assert(contains(id));
  return state_->populations[id.kind].characters[id.index].result;
}

template <int B>
CrowdOutputBound Crowd<B>::outputBound() const noexcept {
  CrowdOutputBound bound;
  for (const crowd::Population& p : state_->populations) {
    const std::size_t alive = p.characters.size() - p.free.size();
    bound.rigs += alive;
    bound.coefficients += alive * p.floats() / 4;
    bound.nearLights += alive * p.nearSlots();
  }
  return bound;
}

template <int B>
CrowdStats Crowd<B>::frame(const CrowdLights& lights, float seconds, const CrowdOutput& output, ParallelFor parallel,
                           CrowdProbe probe) {
  return state_->frame(lights, seconds, output, parallel, probe);
}

template <int B>
std::size_t Crowd<B>::bytesPerCharacter(int kind) const noexcept {
  return state_->populations[static_cast<std::size_t>(kind)].bytesPerCharacter();
}

template <int B>
std::size_t Crowd<B>::bytes() const noexcept {
  std::size_t sum = sizeof(State) + state_->lights.bytes() + state_->schedule.bytes();
  for (const crowd::Task& task : state_->tasks) sum += task.bytes();
  for (const crowd::Population& p : state_->populations)
    sum += sizeof(p) + p.characters.capacity() * sizeof(crowd::Character) +
           p.near.capacity() * sizeof(crowd::NearSlot) + p.results.capacity() * sizeof(float) +
           p.free.capacity() * sizeof(std::uint32_t);
  return sum;
}

template class Crowd<2>;
template class Crowd<3>;
template class Crowd<4>;
template class Crowd<5>;

}  // namespace rigel
