// Everything a report says, as plain data: filled by scene_run, object_run and gallery, written by report_json,
// report_html and report_text. Field names follow report.json.
#pragma once

#include "report/error_breakdown.h"
#include "report/pictures/pixel_frame.h"

#include <rigel/object_lighting.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rigel::tools {

/// Relative to the mean exact irradiance over samples, channels and frames.
struct ErrorFigures {
  double rms = 0;
  double max = 0;
};

struct FrameReport {
  double time = 0;  // s
  double spatialRms = 0;
  double totalRms = 0;
  std::optional<double> estimate;       // of spatialRms, by the rig itself, which does not know the truth
  std::optional<double> totalEstimate;  // of totalRms
  std::optional<double> jump;           // largest change of the error since the frame before; see RigReport::maxJump
  std::optional<double> granted;        // the error that the frame's budget left it to aim at
  int shVectors = 0;
  double modelledNanoseconds = 0;  // a shaded point, by the cost model
  std::vector<int> near;           // lights with a weight above 0, as indices into RigReport::lights
};

/// A light as one rig treats it over the frames of the run.
struct LightReport {
  std::string name;
  std::string type;
  double bound = 0;  // largest over the frames: of the error of leaving it in the rig, relative
  double share = 0;  // of the object's light; mean over the frames
  std::string why;
  std::vector<LightRole> roles;  // per frame
  std::vector<float> weights;    // per frame, evaluated exactly; empty where 0 throughout
  std::vector<float> bounds;     // per frame, relative; empty for lights of little weight and bound

  int framesOf(LightRole role) const { return static_cast<int>(std::ranges::count(roles, role)); }
};

struct StageTime {
  std::string name;
  double microseconds = 0;  // median over frames
};

/// What sharing a frame's time cost an object. Means over the frames.
struct BudgetUse {
  double microseconds = 0;  // modelled, of the object
  double granted = 0;       // error it was lit to

  /// The same rig with the whole time to itself; empty where no other object shares it.
  struct Alone {
    double microseconds = 0, granted = 0;
    double spatialRms = 0, totalRms = 0;
    double shVectors = 0, nearLights = 0;
  };
  std::optional<Alone> alone;
};

struct RigReport {
  std::string spec;
  std::string asked;      // the options that govern its choices: "--near auto --error 0.05"; "" where it has none
  double shVectors = 0;   // mean over the frames, for a rig that chooses their number
  double nearLights = 0;  // lights with a weight above 0, mean over the frames
  int projections = 0;
  ErrorFigures spatial;
  ErrorFigures total;
  std::optional<double> estimate;  // RMS over the frames; empty where a frame has none
  std::optional<double> totalEstimate;
  double fitMicroseconds = 0;  // median over frames of all stages but shading
  double shadeNanosecondsPerPoint = 0;
  double modelledNanoseconds = 0;  // a shaded point, by the cost model; mean over the frames
  int highBandFrames = 0;          // in which the rig held a constant band beyond its own
  std::size_t bytes = 0;           // of the frame with the most SH vectors
  /// What coefficients in half floats would add to the error, at half the bytes; where the device measured it.
  std::optional<ErrorFigures> halfFloat;
  /// Popping: the largest change of the error, at any sample and channel, between frames that follow on each other
  /// (numbered one apart, no clip starting over). Empty where no two of the frames do.
  std::optional<double> maxJump;
  double condition = 1;           // worst condition number of the fit over the frames; 1 where nothing is solved
  std::vector<StageTime> stages;  // those that ran, in their order
  std::vector<FrameReport> frames;
  std::vector<LightReport> lights;  // in the order of the scene's
  std::optional<BudgetUse> budget;  // of a rig that shares the frame's time

  std::optional<ErrorParts> parts;  // empty, as what follows, where no light reaches the object
  std::vector<BodyPartErrors> bodyParts;
  std::optional<ErrorHistogram> histogram;
};

/// A frame's time and the objects of a scene that share it, all lit by one kind of rig.
struct SharedBudget {
  std::string spec;
  double budget = 0;           // us a frame
  std::optional<double> goal;  // error below which no object takes more time; empty: as little as the time allows
  double mean = 0, most = 0;   // modelled us a frame
  int framesOver = 0;          // that take longer than the budget by more than kBudgetSlack
};

/// Per frame, what the truth itself does: its mean and how far it moved since the frame before (RMS over samples).
/// No movement where the frame does not follow on the one looked at before (see RigReport::maxJump).
struct TruthFrame {
  double time = 0;
  double meanIrradiance = 0;
  std::optional<double> movement;  // relative to the run's mean
};

/// One picture in files, relative to the report's directory.
struct Picture {
  std::string label;  // "truth", or a rig spec
  double time = 0;
  int frame = 0;
  std::string imagePng, imageExr;  // "" where not written
  std::string errorPng, errorExr;  // heat map; "" for the truth
  double heatMapMax = 0;           // relative error at the top of the heat map's scale
  double rms = 0;                  // over the object's pixels, relative to the mean irradiance of the run
  std::optional<double> flip;      // FLIP of the PNG and the truth's, mean over the object's pixels; none for the truth
};

struct ObjectReport {
  std::string name;
  int triangles = 0;
  int samples = 0;
  double meanIrradiance = 0;  // the denominator of all relative errors
  std::vector<TruthFrame> truth;
  std::vector<RigReport> rigs;
  std::vector<Picture> pictures;   // all of one frame together: truth first
  std::vector<PixelFrame> pixels;  // for the page, in the order of time
  std::string view3d;              // for the page (view3d_json.h); "" without one
};

struct LightRow {
  std::string name;
  std::string type;
  std::string summary;  // "I 40 40 36 W/sr, radius 0.05 m"
};

/// One way to the light of a disk, measured at the scene's own pairs of a disk and a surface point that it lights.
struct DiskMethodRow {
  std::string method;              // "quadrature-6"; "near" and "wallace" give irradiance alone
  std::string meaning;             // "6 nodes, float: what rigs use"
  std::optional<ErrorFigures> sh;  // of the coefficients, relative to their norm
  ErrorFigures irradiance;         // Lambert, relative to the peak over all normals that the disk gives at the point
  double nanoseconds = 0;          // a disk and point, one at a time
};

/// What one rig of one object did with a disk.
struct DiskUse {
  std::string light, object, rig;
  std::string method;  // of DiskMethodRow::method: "near", "quadrature-6", "near, quadrature-6", or "none"
  std::string why;
};

struct DiskReport {
  std::size_t pairs = 0;
  std::vector<DiskMethodRow> methods;
  std::string choice;  // why rigs and near lights use what they use, in a sentence
  std::vector<DiskUse> uses;
};

struct SceneReport {
  std::string scene;       // as given on the command line
  std::string clip;        // "" for a still scene
  std::string lightsFrom;  // --lights, or ""
  int frames = 0;
  double seconds = 0;  // wall time spent on it
  std::vector<std::string> effects;
  std::vector<std::string> notes;
  std::vector<LightRow> lights;
  std::vector<ObjectReport> objects;
  std::vector<SharedBudget> budgets;  // one a rig that shares the frame's time
  std::optional<DiskReport> disks;    // where the scene has disk lights
  std::string view3d;                 // what its objects' views share; "" without any
};

struct Report {
  std::string version;
  std::string commandLine;
  int bands = 3;
  double exposure = 1;
  double rate = 30;    // frames a second
  std::string device;  // that shaded: a GPU's name, or "" for the CPU
  std::vector<SceneReport> scenes;
};

}  // namespace rigel::tools
