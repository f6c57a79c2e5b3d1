// SPDX-License-Identifier: Apache-2.0
// Where an eye sees ground and sky through air whose refractive index is 1 + refractivity exp(-height / scale):
// docs/theory (14.9) and (14.10). Lengths in one unit, angles in radians. Compiled as double and as GLSL; needs
// model/shared/geometry.glsl.

// By how much higher the eye, at a height, sees a point at a distance in the direction of the cosine mu to the zenith than
// a straight ray would show it: the air is first that along the straight ray, then that along the bent one.
Number lift_by_air(Number height, Number mu, Number distance, Number bottom, Number refractivity, Number scale) {
  Number top = 12.0 * scale;  // no air is above
  Number r = bottom + height;
  Number half_square = sphere_discriminant(bottom, height, mu, top);
  if (half_square <= Number(0.0)) return Number(0.0);
  Number half_chord = sqrt(half_square);
  Number begin = max(-half_chord - r * mu, Number(0.0)), end = min(half_chord - r * mu, distance);
  if (end <= begin) return Number(0.0);
  Number step = (end - begin) / 16.0, sine = sqrt(max(1.0 - mu * mu, Number(0.0))), lift = Number(0.0);
  for (int iteration = 0; iteration < 3; ++iteration) {
    // Of the turns so far, and of their distances from the eye: by these the bent ray is above the straight one.
    Number turned = Number(0.0), moment = Number(0.0);
    for (int i = 0; i < 16; ++i) {
      Number s = begin + step * (Number(float(i)) + 0.5);
      Number h = height_after(bottom, height, mu, s);
      Number level = r * sine / (bottom + h);  // sine of the local zenith angle
      if (iteration > 0) h += level * (lift * s - (s * turned - moment));
      Number turn = refractivity / scale * exp(-max(h, Number(0.0)) / scale) * level * step;
      turned += turn;
      moment += turn * s;
    }
    lift = turned - moment / distance;
  }
  return lift;
}

// Of a ray that is seen below the level of the eye, mu < 0, and misses the ground: the cosine for the straight ray that
// comes as near to the ground.
Number straight_mu_as_near(Number mu, Number height, Number bottom, Number refractivity, Number scale) {
  Number r = bottom + height;
  Number at_eye = refractivity * exp(-height / scale);
  // What the straight ray sinks to, and the bent one by Bouguer's law, below the eye.
  Number straight = r * mu * mu / (1.0 + sqrt(max(1.0 - mu * mu, Number(0.0))));
  Number sinks = min(straight, height);
  for (int i = 0; i < 6; ++i) {
    Number there = refractivity * exp(-(height - sinks) / scale);
    Number value = sinks * (1.0 + there) - r * (there - at_eye) - (1.0 + at_eye) * straight;
    sinks = clamp(sinks - value / (1.0 - (r - sinks) / scale * there), Number(0.0), height);
  }
  Number share = sinks / r;
  return -sqrt(share * (2.0 - share));
}
