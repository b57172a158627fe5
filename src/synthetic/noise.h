// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core/mat.hpp>

#include "orbslam/util/random.h"

namespace orbslam {

/// A random field, CV_32FC1 of about unit variance, whose octaves from 1 texel to coarsest_texels carry equal
/// power: an amplitude spectrum of 1/f, as in photographs (Field, JOSA A 1987). A smoothness s in [0, 1) lets
/// each finer octave have (1 - s) times the amplitude of the next coarser one.
cv::Mat FractalNoise(cv::Size size, int coarsest_texels, double smoothness, Rng* rng);

}  // namespace orbslam
