// SPDX-License-Identifier: Apache-2.0
// The mappings and steps of Hillaire 2020, "A Scalable and Production Ready Sky and Atmosphere Rendering Technique", as his
// published code has them. Compiled as double, as dual numbers and as GLSL, see model/shared/shared.h; needs
// model/shared/geometry.glsl and model/shared/mapping.glsl. Lengths in one unit.

// The sky-view look-up of one eye and one sun, rays that miss the ground. View zenith: x = 0 at the zenith, 1 at the horizon,
// where the texels are densest; angle = (1 - (1 - x)^2) times that of the horizon.
Number hillaire_horizon_angle(Number h, Number bottom) { return acos(-horizon_distance(h, bottom) / (bottom + h)); }
Number hillaire_unit_from_view(Number mu, Number h, Number bottom) {
  Number share = acos(mu) / hillaire_horizon_angle(h, bottom);
  return Number(1.0) - sqrt(max(Number(1.0) - share, Number(0.0)));
}
Number hillaire_view_from_unit(Number x, Number h, Number bottom) {
  Number away = Number(1.0) - x;
  return cos((Number(1.0) - away * away) * hillaire_horizon_angle(h, bottom));
}
// In a table of `rows` rows, the second half of which belongs to rays to the ground: the horizon lies between two rows.
// Counted from 0; a ray to the sky keeps to its half.
Number hillaire_row_from_unit(Number x, Number rows) {
  return min(0.5 * x * (rows - Number(1.0)), 0.5 * rows - Number(1.0));
}
Number hillaire_unit_from_row(Number row, Number rows) { return 2.0 * row / (rows - Number(1.0)); }

// Azimuth from the sun by its cosine: 0 toward the sun, 1 away from it.
Number hillaire_unit_from_azimuth(Number cosine) { return sqrt(max(Number(0.5) - 0.5 * cosine, Number(0.0))); }
Number hillaire_azimuth_from_unit(Number x) { return Number(1.0) - 2.0 * x * x; }

// Where step i of n along a view ray begins, as a share of its length: the steps grow with the distance.
Number hillaire_step_begin(Number i, Number n) { return (i / n) * (i / n); }
// Where within a step the air is looked at.
Number hillaire_sample(Number begin, Number end) { return begin + 0.3 * (end - begin); }
