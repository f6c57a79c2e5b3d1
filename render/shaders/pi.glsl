// SPDX-License-Identifier: Apache-2.0
const float kPi = 3.14159265358979, kInversePi = 0.318309886183790672;
