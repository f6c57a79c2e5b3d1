// SPDX-License-Identifier: Apache-2.0
// Octaves of the noise of sheets of clouds. Compiled by C++ too (render/gl/atmosphere/clouds.cc).
const int kCloudOctaves = 7;
const float kLongestCloud_km = 2600.0f;     // period
const float kCloudRatio = 3.2f;             // of the periods of neighbours
const float kCloudGain = 1.06f;             // of the weights of neighbours, the smaller one's the larger
const float kCloudDeviation = 1.0f / 6.0f;  // of the noise about its mean, 1/2
