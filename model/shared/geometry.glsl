// SPDX-License-Identifier: Apache-2.0
// Rays and spheres about the planet's centre. Compiled as double, as dual numbers and as GLSL, see
// model/shared/shared.h. Heights are measured from the bottom radius R; no expression subtracts two radii, so that a
// float or a planet of 10^9 m loses nothing. Lengths share one unit, which the caller chooses.

// Height after the distance s along a ray that leaves height h with cosine mu to the zenith:
// r'^2 = r^2 + 2 r mu s + s^2.
Number height_after(Number bottom_radius, Number height, Number mu, Number s) {
  Number r = bottom_radius + height;
  Number gain = s * (2.0 * r * mu + s);
  return height + gain / (r + sqrt(r * r + gain));
}

// Discriminant of the ray against the sphere at target_height: r_t^2 - r^2 (1 - mu^2); negative: they do not meet.
Number sphere_discriminant(Number bottom_radius, Number height, Number mu, Number target_height) {
  Number r = bottom_radius + height;
  return (target_height - height) * (target_height + height + 2.0 * bottom_radius) + r * r * mu * mu;
}

// Distance to the sphere at target_height >= height, from inside it.
Number distance_to_outer_sphere(Number bottom_radius, Number height, Number mu, Number target_height) {
  Number r = bottom_radius + height;
  Number half_chord =
      sqrt(max(sphere_discriminant(bottom_radius, height, mu, target_height), Number(0.0)));
  Number above = (target_height - height) * (target_height + height + 2.0 * bottom_radius);
  // The two forms of one root; the sum in each has no cancellation.
  return mu > Number(0.0) ? above / max(half_chord + r * mu, Number(1.0e-30)) : half_chord - r * mu;
}

// Distance to the first hit with the sphere at target_height <= height, for a ray that points down and meets it. At most
// that to the horizon, also where rounding lets a ray that grazes the sphere miss it or point up.
Number distance_to_inner_sphere(Number bottom_radius, Number height, Number mu, Number target_height) {
  Number r = bottom_radius + height;
  Number half_chord =
      sqrt(max(sphere_discriminant(bottom_radius, height, mu, target_height), Number(0.0)));
  Number below = (height - target_height) * (target_height + height + 2.0 * bottom_radius);
  return below / max(max(half_chord - r * mu, sqrt(below)), Number(1.0e-30));
}
