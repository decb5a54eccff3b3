// What `rigel probe` answers to one line.
#include "../../tools/cli/probe.h"

#include <gtest/gtest.h>
#include <rigel/disk.h>
#include <rigel/disk_table.h>
#include <rigel/exact.h>
#include <rigel/project.h>
#include <rigel/wrap.h>

#include <array>
#include <nlohmann/json.hpp>
#include <string>

namespace rigel {
namespace {

using nlohmann::json;
using tools::answerProbe;

constexpr const char* kDisk =
    R"({"type":"disk","position":[0.1,2,0.3],"direction":[0.2,-1,0],"radius":0.7,"radiance":[9,8,7]})";
constexpr const char* kSphere = R"({"type":"sphere","position":[0.1,2,0.3],"radius":0.7,"radiance":[9,8,7]})";

std::string request(const std::string& light, const std::string& rest = "") {
  return R"({"light":)" + light + R"(,"point":[0.25,-0.5,1])" + rest + "}";
}

std::string errorOf(const std::string& line) {
  const json answer = json::parse(answerProbe(line));
  EXPECT_EQ(answer.size(), 1u) << line << " -> " << answer;
  return answer.value("error", "");
}

template <int B>
void expectCoefficients(const json& actual, const RadianceSH<B>& expected) {
  ASSERT_EQ(actual.size(), static_cast<std::size_t>(shCount(B)));
  for (int i = 0; i < shCount(B); ++i) {
    for (int channel = 0; channel < 3; ++channel) {
      // Nine digits name a float uniquely.
      EXPECT_EQ(actual[i][channel].get<float>(), expected[i][channel]) << "coefficient " << i;
    }
  }
}

template <int B, class Light>
void expectAnswer(const std::string& lightText, const Light& light) {
  const std::string line = request(lightText, R"(,"normal":[0,3,4],"wrap":0.5,"bands":)" + std::to_string(B));
  const json answer = json::parse(answerProbe(line));
  ASSERT_FALSE(answer.contains("error")) << line << " -> " << answer;
  const Vec3 p{0.25f, -0.5f, 1};
  const ProjectionWithGradient<B> expected = projectWithGradient<B>(light, p);
  expectCoefficients<B>(answer.at("sh"), expected.value);
  ASSERT_EQ(answer.at("gradient").size(), 3u);
  for (int axis = 0; axis < 3; ++axis) expectCoefficients<B>(answer.at("gradient")[axis], expected.gradient.d[axis]);
  const Rgb fromSh = evaluate(irradianceFromRadiance(expected.value, 0.5f), {0, 0.6f, 0.8f});
  const RgbD exact = exactIrradiance(light, p, {0, 3, 4}, 0.5f);
  for (int channel = 0; channel < 3; ++channel) {
    EXPECT_FLOAT_EQ(answer.at("irradiance_sh")[channel].get<float>(), fromSh[channel]);
    EXPECT_EQ(answer.at("irradiance_exact")[channel].get<double>(), exact[channel]);
  }
}

TEST(Probe, AnswersEveryLightTypeAndBandCount) {
  expectAnswer<2>(R"({"type":"directional","direction":[1,-2,0.5],"irradiance":[1,2,3]})",
                  DirectionalLight{{1, -2, 0.5f}, {1, 2, 3}});
  expectAnswer<3>(R"({"type":"point","position":[1,2,3],"intensity":[4,5,6],"radius":0.1,"range":10})",
                  PointLight{{1, 2, 3}, {4, 5, 6}, 0.1f, 10});
  expectAnswer<4>(
      R"({"type":"spot","position":[1,2,3],"direction":[0,-1,-0.5],"intensity":[4,5,6],"inner":0.2,"outer":1.2})",
      SpotLight{{1, 2, 3}, {0, -1, -0.5f}, {4, 5, 6}, 0.2f, 1.2f});
  expectAnswer<5>(kSphere, SphereLight{{0.1f, 2, 0.3f}, 0.7f, {9, 8, 7}});
  const DiskLight disk{{0.1f, 2, 0.3f}, {0.2f, -1, 0}, 0.7f, {9, 8, 7}};
  expectAnswer<5>(kDisk, disk);
  expectAnswer<2>(kDisk, disk);
  // From behind: nothing, unless both faces shine.
  const DiskLight turned{{1, -2, 3}, {0, -1, 0}, 2, {4, 5, 6}, true};
  expectAnswer<3>(
      R"({"type":"disk","position":[1,-2,3],"direction":[0,-1,0],"radius":2,"radiance":[4,5,6],"two_sided":true})",
      turned);
  EXPECT_GT(project<3>(turned, {0.25f, -0.5f, 1})[0].r, 0);
}

template <int B>
void expectMethods() {
  const DiskLight disk{{0.1f, 2, 0.3f}, {0.2f, -1, 0}, 0.7f, {9, 8, 7}};
  const Vec3 p{0.25f, -0.5f, 1};
  const auto answerBy = [](const std::string& method) {
    return json::parse(answerProbe(
        request(kDisk, R"(,"bands":)" + std::to_string(B) + R"(,"normal":[0,3,4],"method":")" + method + "\"")));
  };
  const json quadrature = answerBy("quadrature"), table = answerBy("table"), exact = answerBy("exact");
  expectCoefficients<B>(quadrature.at("sh"), project<B>(disk, p));
  expectCoefficients<B>(table.at("sh"), DiskTable::project<B>(disk, p));
  EXPECT_NE(table.at("sh"), quadrature.at("sh")) << "the method was not heard";
  std::array<double, 3 * shCount(B)> numbers{};
  projectDiskExact(disk, p, B, numbers);
  ASSERT_EQ(exact.at("sh").size(), static_cast<std::size_t>(shCount(B)));
  for (int i = 0; i < 3 * shCount(B); ++i) EXPECT_EQ(exact.at("sh")[i / 3][i % 3].get<double>(), numbers[i]) << i;
  for (const json& other : {table, exact}) {
    EXPECT_EQ(other.at("gradient"), quadrature.at("gradient"));
    EXPECT_EQ(other.at("irradiance_exact"), quadrature.at("irradiance_exact"));
    EXPECT_NEAR(other.at("irradiance_sh")[0].get<double>(), quadrature.at("irradiance_sh")[0].get<double>(), 1e-3);
  }
}

TEST(Probe, DisksAnswerByTheMethodAskedFor) {
  expectMethods<2>();
  expectMethods<3>();
  expectMethods<4>();
  expectMethods<5>();
}

TEST(Probe, LeavesOutWhatIsOptional) {
  const json answer = json::parse(answerProbe(request(kSphere)));
  EXPECT_EQ(answer.at("sh").size(), 9u);
  EXPECT_FALSE(answer.contains("irradiance_sh"));
  EXPECT_FALSE(answer.contains("irradiance_exact"));
  // Defaults of a point light: radius 0.01, no range.
  const json point = json::parse(answerProbe(request(R"({"type":"point","position":[1,2,3],"intensity":[4,5,6]})")));
  expectCoefficients<3>(point.at("sh"), project<3>(PointLight{{1, 2, 3}, {4, 5, 6}}, {0.25f, -0.5f, 1}));
}

TEST(Probe, RoundsItsInputToFloat) {
  const std::string exact =
      R"({"type":"sphere","position":[0,2,0],"radius":0.100000001490116119384765625,"radiance":[1,1,1]})";
  const std::string decimal = R"({"type":"sphere","position":[0,2,0],"radius":0.1,"radiance":[1,1,1]})";
  EXPECT_EQ(answerProbe(request(exact)), answerProbe(request(decimal)));
}

TEST(Probe, IrradianceIsNotClamped) {
  // Facing away from a small light the truth is 0 and three bands ring below it.
  const json answer = json::parse(answerProbe(
      R"({"light":{"type":"sphere","position":[0,2,0],"radius":0.1,"radiance":[1,1,1]},"point":[0,0,0],"normal":[0.9,-0.43,0]})"));
  EXPECT_EQ(answer.at("irradiance_exact")[0].get<double>(), 0);
  EXPECT_LT(answer.at("irradiance_sh")[0].get<double>(), 0);
}

TEST(Probe, NamesWhatItCannotServe) {
  const auto sphere = [](const std::string& fields) { return request(R"({"type":"sphere",)" + fields + "}"); };
  const std::pair<std::string, std::string> cases[] = {
      {"", "not JSON"},
      {"   ", "not JSON"},
      {"{", "not JSON"},
      {"\xff\xfe{}", "not JSON"},
      {std::string("{\"a\0b\":1}", 9), "not JSON"},
      {"[]", "not an object"},
      {"3", "not an object"},
      {"{}", "missing field \"light\""},
      {R"({"light":3,"point":[0,0,0]})", "\"light\" is not an object"},
      {R"({"light":{},"point":[0,0,0]})", "missing field \"type\""},
      {request(R"({"type":7})"), "\"type\" is not a string"},
      {request(R"({"type":"tube"})"), "unknown light type \"tube\""},
      {request(R"({"type":"disk","position":[0,2,0],"direction":[0,0,0],"radius":1,"radiance":[1,1,1]})"),
       "\"direction\" has length zero"},
      {request(R"({"type":"disk","position":[0,2,0],"radius":1,"radiance":[1,1,1]})"), "missing field \"direction\""},
      {request(R"({"type":"disk","position":[0,2,0],"direction":[0,1,0],"radius":-1,"radiance":[1,1,1]})"),
       "\"radius\" is negative"},
      {request(R"({"type":"disk","position":[0,2,0],"direction":[0,1,0],"radius":1,"radiance":[1,1,1],"two_sided":1})"),
       "\"two_sided\" is not true or false"},
      {request(
           R"({"type":"disk","position":[0,2,0],"direction":[0,1,0],"radius":1,"radiance":[1,1,1],"method":"table"})"),
       "a disk light has no field \"method\""},
      {request(kDisk, R"(,"method":"guess")"), "\"method\" is not one of table, quadrature, exact"},
      {request(kDisk, R"(,"method":1)"), "\"method\" is not a string"},
      {request(kSphere, R"(,"method":"table")"), "\"method\" is for disk lights alone"},
      {std::string(R"({"light":)") + kSphere + "}", "missing field \"point\""},
      {sphere(R"("radius":1,"radiance":[1,1,1])"), "missing field \"position\""},
      {sphere(R"("position":[0,1,2],"radiance":[1,1,1])"), "missing field \"radius\""},
      {sphere(R"("position":[0,1],"radius":1,"radiance":[1,1,1])"), "\"position\" is not an array of three numbers"},
      {sphere(R"("position":[0,1,"2"],"radius":1,"radiance":[1,1,1])"), "\"position\" is not a number"},
      {sphere(R"("position":[0,1,true],"radius":1,"radiance":[1,1,1])"), "\"position\" is not a number"},
      {sphere(R"("position":[0,1,null],"radius":1,"radiance":[1,1,1])"), "\"position\" is not a number"},
      {sphere(R"("position":[0,1,1e39],"radius":1,"radiance":[1,1,1])"), "out of the range of float"},
      {sphere(R"("position":[0,1,1e999],"radius":1,"radiance":[1,1,1])"), "not JSON"},
      {sphere(R"("position":[0,1,NaN],"radius":1,"radiance":[1,1,1])"), "not JSON"},
      {sphere(R"("position":[0,1,2],"radius":-1,"radiance":[1,1,1])"), "\"radius\" is negative"},
      {sphere(R"("position":[0,1,2],"radius":1,"radiance":[1,1,1],"range":3)"), "has no field \"range\""},
      {request(R"({"type":"point","position":[0,1,2],"intensity":[1,1,1],"radius":-0.1})"), "\"radius\" is negative"},
      {request(R"({"type":"point","position":[0,1,2],"intensity":[1,1,1],"range":0})"), "\"range\" is not positive"},
      {request(R"({"type":"directional","direction":[0,0,0],"irradiance":[1,1,1]})"), "\"direction\" has length zero"},
      {request(R"({"type":"spot","position":[0,1,2],"direction":[0,1,0],"intensity":[1,1,1],"inner":1,"outer":0.5})"),
       "inner <= outer"},
      {request(R"({"type":"spot","position":[0,1,2],"direction":[0,1,0],"intensity":[1,1,1],"outer":4})"),
       "outer <= pi"},
      {request(kSphere, R"(,"normal":[0,0,0])"), "\"normal\" has length zero"},
      {request(kSphere, R"(,"normal":[1e-60,0,0])"), "\"normal\" has length zero"},
      {request(kSphere, R"(,"wrap":1.5)"), "\"wrap\" is not within -0.25 to 1"},
      {request(kSphere, R"(,"wrap":-0.3)"), "\"wrap\" is not within"},
      {request(kSphere, R"(,"bands":1)"), "\"bands\" is not one of 2 to 5"},
      {request(kSphere, R"(,"bands":6)"), "\"bands\" is not one of"},
      {request(kSphere, R"(,"bands":2.5)"), "\"bands\" is not one of"},
      {request(kSphere, R"(,"bands":"3")"), "\"bands\" is not a number"},
  };
  for (const auto& [line, message] : cases) {
    EXPECT_NE(errorOf(line).find(message), std::string::npos) << line << "\n  -> " << errorOf(line);
  }
}

TEST(Probe, AnswersStayOnOneLine) {
  for (const std::string& line :
       {request(kSphere, R"(,"normal":[0,1,0])"), std::string("{\n"), std::string("\"\\n\"")}) {
    EXPECT_EQ(answerProbe(line).find('\n'), std::string::npos) << line;
  }
}

TEST(Probe, SurvivesAnyTruncation) {
  const std::string line = request(kSphere, R"(,"normal":[0,1,0],"wrap":0.5,"bands":4)");
  for (std::size_t length = 0; length < line.size(); ++length) {
    EXPECT_FALSE(errorOf(line.substr(0, length)).empty()) << line.substr(0, length);
  }
  EXPECT_FALSE(errorOf(std::string(100000, '[')).empty());
}

}  // namespace
}  // namespace rigel
