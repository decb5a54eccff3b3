// Inputs as text, with all digits, for failure messages.
#pragma once

#include <rigel/light.h>

#include <string>

namespace rigel::test {

std::string describe(float value);
std::string describe(double value);
std::string describe(Vec3 v);
std::string describe(Rgb c);
std::string describe(const DirectionalLight& light);
std::string describe(const PointLight& light);
std::string describe(const SpotLight& light);
std::string describe(const SphereLight& light);
std::string describe(const DiskLight& light);

}  // namespace rigel::test
