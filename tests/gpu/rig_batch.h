// Many rigs in one run of a shader function, beside their C++ twins and the double reference, families apart.
//
// lavapipe compiles a shader anew for every value of a uniform that a condition hangs on. Here a row chooses its rig,
// so that there is nothing for it to take for a constant: one compilation for rigs of every kind on every body.
#pragma once

#include "gpu/rig_twin.h"

#include <deque>

namespace rigel::test {

inline constexpr int kBatchRigs = 32;

/// As rigSource; `body` has `rig`, of the row.
inline tools::ShaderFunctionSource batchSource(int bands, const std::string& defines, const std::string& body,
                                               bool wantsSh = false) {
  tools::ShaderFunctionSource source = rigSource(bands, defines, "GpuRig rig = shared_.rigs[which];\n" + body, wantsSh);
  source.inputs.insert(source.inputs.begin(), "int which");
  source.uniforms = "GpuRig rigs[" + std::to_string(kBatchRigs) + "];";
  return source;
}

inline std::string distanceText(double distance) {
  std::ostringstream text;
  text << ", " << distance << " m away";
  return text.str();
}

template <int B>
class RigBatch {
 public:
  /// The rig on every body at every distance, at so many points of each; of `auto` prefixes, as in frames that need
  /// less. To be called once.
  void addFamilies(const std::string& spec, int pointsOfEach, Random& random) {
    for (const RigBody& body : rigBodies()) {
      const Rig& rig = rigs_.emplace_back(rigOn(spec, body, random));
      for (const double distance : kFrameDistances) {
        const int vectors = rig.spec().adaptive ? 1 + random.index(rig.shVectors()) : rig.shVectors();
        runs_.emplace_back(spec + " on the " + body.name, rig, randomFrame(random, distance), vectors, pointsOfEach,
                           random);
        // A point has no coordinates to lose.
        families_.push_back(familyOf(rig.spec()) + " on the " + body.name +
                            (body.name == "point" ? "" : distanceText(distance)));
      }
    }
  }

  /// `function` of batchSource gives irradiance, or SH.
  void check(tools::ShaderFunction& function, bool wantsSh, TwinFamilies& families) const {
    const std::vector<float> results = evaluate(function);
    auto from = results.begin();
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      const RigRun<B>& run = runs_[i];
      const auto to = from + static_cast<std::ptrdiff_t>(run.points.size()) * function.outputFloats();
      TwinCheck& check = families[families_[i]];
      TwinCheck& nowhere = families["a point without a number"];
      if (wantsSh)
        run.checkSh({from, to}, check, &nowhere);
      else
        run.checkIrradiance({from, to}, check, &nowhere);
      from = to;
    }
  }

 private:
  /// Rigs that are summed alike.
  static std::string familyOf(const RigSpec& spec) {
    if (spec.fit == FitMethod::gauss) return "@gauss";
    if (spec.kernel == LatticeKernel::smooth) return "smooth";
    if (spec.kernel == LatticeKernel::cubic) return "cubic";
    const std::string model = spec.text.substr(0, spec.text.find_first_of(":@"));
    if (model != "poly") return model;
    return model + (spec.terms <= 4 ? " of degree 1" : spec.terms <= 10 ? " of degree 2" : " of higher degree");
  }
  std::vector<float> evaluate(tools::ShaderFunction& function) const {
    // Always of one size, or lavapipe compiles anew.
    std::vector<GpuVec4> buffer(1 << 17, GpuVec4{kNan, kNan, kNan, kNan});
    std::vector<GpuRig> packed(kBatchRigs);
    std::vector<float> rows;
    int offset = 5;
    EXPECT_LE(runs_.size(), packed.size());
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      const RigRun<B>& run = runs_[i];
      packed[i] = run.packInto(buffer, offset);
      const std::vector<float> own = run.rows();
      const std::size_t width = own.size() / run.points.size();
      for (std::size_t row = 0; row < own.size(); row += width) {
        rows.push_back(static_cast<float>(i));
        rows.insert(rows.end(), own.begin() + static_cast<std::ptrdiff_t>(row),
                    own.begin() + static_cast<std::ptrdiff_t>(row + width));
      }
    }
    function.setUniforms(std::as_bytes(std::span(packed)));
    function.setTexels(floatsOf(buffer));
    return run(function, rows);
  }

  static constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  std::deque<Rig> rigs_;
  std::deque<RigRun<B>> runs_;
  std::vector<std::string> families_;  // of each run
};

}  // namespace rigel::test
