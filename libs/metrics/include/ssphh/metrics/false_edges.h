#pragma once
/// False edges: steps in a picture of indirect light that the truth has not (patches, facets, saw teeth),
/// which the eye sees first and an average forgives.

#include <cstdint>

#include <ssphh/image/io.h>

namespace ssphh::metrics {

/// Pictures of one size; an empty albedo, normal or depth is not looked at.
struct SurfacePicture {
  image::Image indirect;  ///< radiance of indirect light [W sr⁻¹ m⁻²]
  image::Image albedo;    ///< what `indirect` is divided by; pixels under 0.01 in some channel are left out
  image::Image normal;    ///< unit; of the truth alone
  image::Image depth;     ///< 1 channel, 0 or infinite where nothing stands; of the truth alone
};

struct FalseEdgeParams {
  /// Least step of log irradiance that counts, in luminance. The eye's threshold for a sharp edge is about 1
  /// % (Barten, Contrast Sensitivity of the Human Eye, 1999: a modulation of 0.3 to 0.5 % at its best); 3 %
  /// is seen without looking for it.
  double threshold = 0.03;
  /// The same of red against green and of blue against both, to which the eye is less sensitive where edges
  /// are sharp (Mullen, The contrast sensitivity of human colour vision, 1985).
  double opponent_threshold = 0.06;
  double sigmas = 4;    ///< standard errors that a step must have besides
  double floor = 0.05;  ///< added to irradiance, times the truth's mean: darkness does not decide
  int across = 8;       ///< pixels on either side of an edge that a step is fitted to, 3 to 32
  int along = 8;        ///< pixels along it, both ways, 0 to 32
};

struct FalseEdges {
  std::uint64_t pixels = 0;  ///< of the picture
  std::uint64_t tested = 0;  ///< pixels with enough of one surface around
  std::uint64_t edges = 0;   ///< of these: pixels on a false edge
  double share = 0;          ///< edges / tested; 0 where none could be tested
  double least_step = 0;     ///< median over tested pixels of the step that would have counted in luminance:
                             ///< over `threshold` where the pictures are too noisy for it
  image::Image map;  ///< 1 channel: size of the step at false edges, 0 at other tested pixels, else NaN
};

/// At each pair of pixels, in eight directions, the logarithms of the pictures divided by their albedo, in
/// luminance and two opponent colours, are fitted by a plane and a step s, a + b·x + c·y + s·H(x), over those
/// pixels around that are of one surface: joined by normals that turn less than 10° a pixel and depths that
/// go on. The pair is on a false edge where the test steps, by over the threshold and within two pixels, and
/// the truth does not: their steps differ by over the threshold and over `sigmas` standard errors (from the
/// residuals of log(test / truth): the noise of both), and the truth's is under half the test's. The truth's
/// step is that of the smallest of four windows, up to three times the size asked for, that tells the two
/// apart; what is short and faint in a noisy truth goes under in it. Not where the albedo steps as well, by a
/// tenth: that is what the eye sees there. Throws Error for pictures of other sizes and parameters out of
/// range.
FalseEdges false_edges(const SurfacePicture& truth, const SurfacePicture& test,
                       const FalseEdgeParams& params = {});

/// The map over `picture` in grey, of its size, its 99th percentile white: false edges from red to white,
/// where a step of `scale` is; what could not be tested is blue. A scale of 0 takes 0.2.
image::Rgba8 edge_picture(const FalseEdges& edges, const image::Image& picture, float scale = 0);

}  // namespace ssphh::metrics
