// rigel probe: lights measured one request a line, for scripts and checks.
#include "command.h"
#include "probe.h"

#include <iostream>
#include <string>

namespace rigel::tools {
namespace {

constexpr const char* kFooter = R"(Request, one JSON object a line; wrap (0), bands (3) and normal may be left out:

  {"light":{"type":"sphere","position":[0,2,0],"radius":0.5,"radiance":[9,8,7]},"point":[0,0,0],"normal":[0,1,0],"wrap":0,"bands":3}

Light types and their fields (metres, radians; direction is the way the light travels):
  directional  direction, irradiance
  point        position, intensity, radius (0.01), range (none)
  spot         the same and direction, inner (0), outer (pi/4)
  sphere       position, radius, radiance
  disk         position, direction, radius, radiance, two_sided (false)
A request with a disk may say "method": "quadrature" (6 nodes, float: the default), "table" (32x32, float) or "exact"
(double, 1e-10): how its sh is found. The gradient is the quadrature's whatever it says.

Answer, one a line:
  sh                radiance projection, [R,G,B] for each of bands^2 coefficients; neither pi nor wrap in it
  gradient          its derivatives by x, y and z of the point
  irradiance_sh     from sh, the wrap and the normal, not clamped at 0
  irradiance_exact  true shape, clipped at the horizon
The irradiances need a normal, which need not be unit: it is normalised. Numbers are rounded to float first. A request
that cannot be served is answered by {"error":"..."}, and the next line is read.)";

int run() {
  std::string line;
  while (std::getline(std::cin, line)) {
    std::cout << answerProbe(line) << std::endl;  // flushed line by line: scripts talk to it through a pipe
    if (!std::cout) return fail(kExitBadInput, "probe: cannot write the answer");
  }
  return kExitOk;
}

}  // namespace

Command addProbe(CLI::App& root) {
  CLI::App* app = root.add_subcommand("probe", "Answer questions about single lights: JSON lines in, JSON lines out");
  app->footer(kFooter);
  return {app, run};
}

}  // namespace rigel::tools
