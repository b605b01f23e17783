#pragma once
/// Radiance coefficients of three light probes as Ramamoorthi and Hanrahan published them (SIGGRAPH 2001; the
/// digits as they stand in the widespread GLSL samples that cite the paper). Light probe images by Paul
/// Debevec.

#include <ssphh/sh/coefficients.h>

namespace ssphh::test {

inline sh::RadianceSh grace_cathedral() {
  sh::RadianceSh sh;
  sh.values = {
      {0.78908f, 0.43710f, 0.54161f},    {0.39499f, 0.34989f, 0.60488f},    {-0.33974f, -0.18236f, -0.26940f},
      {-0.29213f, -0.05562f, 0.00944f},  {-0.11141f, -0.05090f, -0.12231f}, {-0.26240f, -0.22401f, -0.47479f},
      {-0.15570f, -0.09471f, -0.14733f}, {0.56014f, 0.21444f, 0.13915f},    {0.21205f, -0.05432f, -0.30374f}};
  return sh;
}

inline sh::RadianceSh eucalyptus_grove() {
  sh::RadianceSh sh;
  sh.values = {{0.3783264f, 0.4260425f, 0.4504587f},    {0.2887813f, 0.3586803f, 0.4147053f},
               {0.0379030f, 0.0295216f, 0.0098567f},    {-0.1033028f, -0.1031690f, -0.0884924f},
               {-0.0621750f, -0.0554432f, -0.0396779f}, {0.0077820f, -0.0148312f, -0.0471301f},
               {-0.0935561f, -0.1254260f, -0.1525629f}, {-0.0572703f, -0.0502192f, -0.0363410f},
               {0.0203348f, -0.0044201f, -0.0452180f}};
  return sh;
}

inline sh::RadianceSh st_peters_basilica() {
  sh::RadianceSh sh;
  sh.values = {{0.3623915f, 0.2624130f, 0.2326261f},    {0.1759130f, 0.1436267f, 0.1260569f},
               {-0.0247311f, -0.0101253f, -0.0010745f}, {0.0346500f, 0.0223184f, 0.0101350f},
               {0.0198140f, 0.0144073f, 0.0043987f},    {-0.0469596f, -0.0254485f, -0.0117786f},
               {-0.0898667f, -0.0760911f, -0.0740964f}, {0.0050194f, 0.0038841f, 0.0001374f},
               {-0.0818750f, -0.0321501f, 0.0033399f}};
  return sh;
}

}  // namespace ssphh::test
