// SPDX-License-Identifier: Apache-2.0
// The mappings between rays and look-up tables. Source: Bruneton 2017, "Precomputed Atmospheric Scattering: a New
// Implementation", functions.glsl. Deviation: a point is given by its height h above the bottom radius instead of its
// distance r from the centre, and every difference of squares is factored, so that single precision keeps its digits:
// r = 6 360 000 m resolves half a metre in a float, h = 2 m resolves a micrometre.
// Compiled as double, as dual numbers and as GLSL, see model/shared/shared.h; needs model/shared/geometry.glsl.
//
// Lengths in any one unit: `bottom` is the planet's radius, `thickness` the height of the top of the atmosphere.
// mu = cos(view zenith) and mu_s = cos(sun zenith) at the point; x_* is a table coordinate in [0, 1], before half texels
// are taken into account; hits_ground says which half of the scattering table a view ray belongs to.

// Distance to the tangent point on the ground: sqrt(r^2 - bottom^2).
Number horizon_distance(Number h, Number bottom) {
  return sqrt(max(h * (2.0 * bottom + h), Number(0.0)));
}

// Length of a tangent to the ground, from the ground to the top of the atmosphere: H of Bruneton 2017.
Number longest_tangent(Number bottom, Number thickness) {
  return horizon_distance(thickness, bottom);
}

// Whether the ray meets the ground sphere.
bool ray_hits_ground(Number h, Number mu, Number bottom) {
  return -(bottom + h) * mu > horizon_distance(h, bottom);
}

// Texture coordinate of x in [0, 1] in a table of `size` texels: half a texel, so that 0 and 1 hit texel centres.
Number texture_from_unit(Number x, Number size) { return 0.5 / size + x * (1.0 - 1.0 / size); }

// docs/theory (9.1).
// Heights: about the logarithm of sqrt(h). Dense near the ground, where a ray along the ground changes with sqrt(h);
// higher up the texels of 32 are 0.1 to 0.2 of their height apart. Deviation: Bruneton 2017 takes sqrt(h), which is coarse
// within the aerosol.
Number unit_from_height(Number h, Number thickness) {
  return log(1.0 + sqrt(max(h * (1.0 / (0.03 * thickness)), Number(0.0)))) * 0.522734142387;  // 1 / log(1 + sqrt(1 / 0.03))
}

Number height_from_unit(Number x_r, Number thickness) {
  Number root = exp(x_r * 1.913018337454) - 1.0;
  return 0.03 * thickness * root * root;
}

// docs/theory (9.2).
// Rays that leave through the top; this is the whole mapping of the transmittance table and the upper half of the
// scattering table.
Number unit_from_upward_ray(Number h, Number mu, Number bottom, Number thickness) {
  Number shortest = thickness - h;
  Number longest = horizon_distance(h, bottom) + longest_tangent(bottom, thickness);
  Number d = distance_to_outer_sphere(bottom, h, mu, thickness);
  return clamp((d - shortest) / (longest - shortest), Number(0.0), Number(1.0));
}

Number mu_from_upward_unit(Number x_mu, Number h, Number bottom, Number thickness) {
  Number shortest = thickness - h;
  Number longest = horizon_distance(h, bottom) + longest_tangent(bottom, thickness);
  Number d = shortest + x_mu * (longest - shortest);
  Number above = (thickness - h) * (2.0 * bottom + thickness + h);  // top^2 - r^2
  Number mu = (above - d * d) / max(2.0 * (bottom + h) * d, Number(1e-30));
  return d > Number(0.0) ? clamp(mu, Number(-1.0), Number(1.0)) : Number(1.0);
}

// Rays that end on the ground: the lower half of the scattering table.
Number unit_from_ground_ray(Number h, Number mu, Number bottom) {
  Number longest = horizon_distance(h, bottom);
  Number d = distance_to_inner_sphere(bottom, h, mu, Number(0.0));
  Number unit = (d - h) / max(longest - h, Number(1e-30));
  return longest > h ? clamp(unit, Number(0.0), Number(1.0)) : Number(0.0);
}

Number mu_from_ground_unit(Number x_mu, Number h, Number bottom) {
  Number longest = horizon_distance(h, bottom);
  Number d = h + x_mu * (longest - h);
  Number mu = -(longest * longest + d * d) / max(2.0 * (bottom + h) * d, Number(1e-30));
  return d > Number(0.0) ? clamp(mu, Number(-1.0), Number(1.0)) : Number(-1.0);
}

// docs/theory (9.4).
// The dip by which the sun's height is counted at a point above the ground. Seven tenths of the horizon's: the beam that
// grazes the ground is dark, and what dims or lights the air is one that passes higher.
Number sun_dip(Number h, Number bottom) { return 0.7 * horizon_distance(h, bottom) / (bottom + h); }

// The sun's height at a point: 1 in the zenith, 0 at the edge of the planet's shadow, of which the cosine alone knows
// nothing above the ground. Light changes fastest there, at any height h.
Number sun_height(Number h, Number mu_s, Number bottom) {
  Number dip = sun_dip(h, bottom);
  return (mu_s + dip) / (1.0 + dip);
}

Number mu_s_from_sun_height(Number h, Number height, Number bottom) {
  Number dip = sun_dip(h, bottom);
  return clamp(height * (1.0 + dip) - dip, Number(-1.0), Number(1.0));
}

// docs/theory (9.5).
// Coordinate of the sun's height, by t = sqrt(1 - height), which is nearly the zenith angle; finest, 0.3
// degrees with 64 texels, at the edge of the shadow, on which the 22nd of them lies when the lowest sun is -0.2079: the
// light has a kink there. Deviation: Bruneton 2017 takes distances to the top, which leaves 3 of 48 texels for suns
// within 60 degrees of the zenith.
Number sun_curve(Number t) {
  Number x = 40.0 * (1.0053 - t);
  return log(x + sqrt(x * x + 1.0));  // asinh
}

Number unit_from_sun(Number height, Number lowest) {
  Number least = sun_curve(sqrt(1.0 - lowest));
  Number t = sqrt(max(1.0 - max(height, lowest), Number(0.0)));
  return (sun_curve(t) - least) * (1.0 / (sun_curve(Number(0.0)) - least));
}

Number sun_from_unit(Number x, Number lowest) {
  Number least = sun_curve(sqrt(1.0 - lowest));
  Number e = exp(least + x * (sun_curve(Number(0.0)) - least));
  Number t = 1.0053 - 0.0125 * (e - 1.0 / e);  // sinh
  return clamp(1.0 - t * t, lowest, Number(1.0));
}

// docs/theory (9.7).
// How high the light of the night side comes from, where the atmosphere is thick against its planet: 110 km on Titan, 0
// on Mars and the Earth. By the shape of the planet alone, so that it stays while constituents change.
Number height_of_night_haze(Number bottom, Number thickness) {
  return max(0.3 * (thickness - 0.05 * bottom), Number(0.0));
}

// The sun's height and azimuth in the scattering table are those at a point of the ray about which most of the light is
// scattered: along a limb they change by many degrees, and with the azimuth. Of a ray that ends on the ground it is where
// the ray comes down to the haze of the night; otherwise three quarters of the way to the ray's lowest point, rounded off
// over a hundredth of the radius, so that rays to either side of the horizontal go together. Distance to that point.
// Deviation: Bruneton 2017 takes the sun at the ray's beginning.
Number distance_to_sun_point(Number h, Number mu, bool hits_ground, Number bottom, Number thickness) {
  if (hits_ground) {
    Number haze = height_of_night_haze(bottom, thickness);
    return h > haze ? distance_to_inner_sphere(bottom, h, mu, haze) : Number(0.0);
  }
  Number descent = -(bottom + h) * mu;
  Number width = 0.01 * bottom;
  Number root = sqrt(descent * descent + width * width);
  // The two forms of one root; the sum in each has no cancellation.
  Number lowest = descent > Number(0.0) ? 0.5 * (descent + root) : 0.5 * width * width / (root - descent);
  return min(0.75 * lowest, distance_to_outer_sphere(bottom, h, mu, thickness));
}

// The sun's azimuth from the view's, 0 toward the sun: what is possible for a view and a sun fills the table, which it
// does not by nu. Deviation: Bruneton 2017 takes nu.
Number cosine_of_azimuth(Number mu, Number mu_s, Number nu) {
  Number sines = sqrt(max((1.0 - mu * mu) * (1.0 - mu_s * mu_s), Number(0.0)));
  return clamp((nu - mu * mu_s) / max(sines, Number(1e-7)), Number(-1.0), Number(1.0));
}

// docs/theory (9.6).
// Coordinate of the azimuth: with 14 texels steps of 6 degrees toward the sun, where light of higher orders still shows
// the forward lobe of what scatters it, and of 16 away from it. By turns t = phi / pi, 1.18 x = t + 0.2 t / (t + 0.1).
Number unit_from_azimuth(Number cosine) {
  Number t = acos(cosine) * 0.318309886183790672;  // 1 / pi
  return t * (t + 0.3) / ((t + 0.1) * 1.181818181818);
}

Number cosine_from_azimuth_unit(Number x) {
  Number y = 1.181818181818 * x;
  return cos(1.570796326794897 * (y - 0.3 + sqrt((y - 0.3) * (y - 0.3) + 0.4 * y)));
}

// Rays to the sky, whose brightness changes fastest along the limb: coordinate of the square root of Bruneton's
// distance, x = s at both ends, 1.8 times as coarse as s at the zenith and 5 times as fine at the horizon.
Number sky_from_root(Number s) { return 0.625 * (1.8 - sqrt(max(3.24 - 3.2 * s, Number(0.0)))); }
Number root_from_sky(Number x) { return x * (1.8 - 0.8 * x); }

// A deck is the top of a layer, at the height `deck`, beyond whose horizon it is not seen; negative: there is none.
// Cosine of the view zenith of that horizon; of the horizontal for an eye below.
Number deck_cosine(Number h, Number deck, Number bottom) {
  Number above = max((h - deck) * (2.0 * bottom + h + deck), Number(0.0));
  return -sqrt(above) / (bottom + h);
}

// Coordinate of rays to the sky, 0 at the ground's horizon and 1 in the zenith.
Number unit_from_sky_ray(Number h, Number mu, Number bottom, Number thickness) {
  return 1.0 - sky_from_root(sqrt(unit_from_upward_ray(h, mu, bottom, thickness)));
}

// docs/theory (9.14).
// Rays below the horizon of a deck have a third of that coordinate, closest to that horizon, where the light changes with
// the square root of the angle.
Number share_below_deck() { return Number(1.0 / 3.0); }

Number unit_beside_deck(Number x, Number edge) {
  Number share = share_below_deck();
  Number below = clamp(x / edge, Number(0.0), Number(1.0));
  return x < edge ? share * (1.0 - sqrt(1.0 - below)) : share + (1.0 - share) * (x - edge) / (1.0 - edge);
}

Number sky_unit_beside_deck(Number unit, Number edge) {
  Number share = share_below_deck();
  Number rest = 1.0 - min(unit / share, Number(1.0));
  return unit < share ? edge * (1.0 - rest * rest) : edge + (1.0 - edge) * (unit - share) / (1.0 - share);
}

// Where the deck's horizon lies in unit_from_sky_ray().
Number deck_edge(Number h, Number bottom, Number thickness, Number deck) {
  return clamp(unit_from_sky_ray(h, deck_cosine(h, deck, bottom), bottom, thickness), Number(1e-6), Number(1.0 - 1e-6));
}

// docs/theory (9.3).
// Texture coordinate of the view zenith in the scattering table, from the nadir to the zenith: rays to the ground have
// the first ground_size texels, rays to the sky the other sky_size; the two meet at the horizon and share no texel.
// Deviation: powers of Bruneton's distances, which spread the texels over the sky instead of one over the 30 degrees
// about the zenith.
Number texture_from_view(Number h, Number mu, bool hits_ground, Number ground_size, Number sky_size, Number bottom,
                         Number thickness, Number deck) {
  if (hits_ground) {
    Number ground = pow(unit_from_ground_ray(h, mu, bottom), Number(0.4));
    return (0.5 + ground * (ground_size - 1.0)) * (1.0 / (ground_size + sky_size));
  }
  Number sky = unit_from_sky_ray(h, mu, bottom, thickness);
  if (deck >= Number(0.0)) sky = unit_beside_deck(sky, deck_edge(h, bottom, thickness, deck));
  return (ground_size + 0.5 + sky * (sky_size - 1.0)) * (1.0 / (ground_size + sky_size));
}

Number mu_from_texture(Number u, Number h, Number ground_size, Number sky_size, Number bottom, Number thickness,
                       Number deck) {
  Number texel = u * (ground_size + sky_size) - 0.5;
  if (texel < ground_size - 0.5) {
    return mu_from_ground_unit(pow(max(texel, Number(0.0)) / (ground_size - 1.0), Number(2.5)), h, bottom);
  }
  Number unit = max(texel - ground_size, Number(0.0)) / (sky_size - 1.0);
  if (deck >= Number(0.0)) unit = sky_unit_beside_deck(unit, deck_edge(h, bottom, thickness, deck));
  Number sky = root_from_sky(1.0 - unit);
  return mu_from_upward_unit(sky * sky, h, bottom, thickness);
}

// Where a view ray meets the atmosphere when the eye may be outside: distance to the first point inside, 0 when the eye
// is inside, negative when the ray misses. (bottom + h) is the eye's distance from the centre.
Number distance_to_atmosphere(Number h, Number mu, Number bottom, Number thickness) {
  if (h < thickness) return Number(0.0);
  Number along = -(bottom + h) * mu;
  Number outside = (h - thickness) * (2.0 * bottom + thickness + h);  // r^2 - top^2
  Number rest = along * along - outside;
  if (along < Number(0.0) || rest < Number(0.0)) return Number(-1.0);
  return outside / (along + sqrt(rest));
}
