// SPDX-License-Identifier: Apache-2.0
// Starts the page; window.skyfit is described in docs/view.md.

const percent = (share) =>
    (share < 1 ? `${(100 * share).toPrecision(2)} %` : `a factor ${(1 + share).toPrecision(2)}`);

function describe() {
  element('note').textContent = data.preset.note;
  const skies = data.errors.map(
      ({altitude_m: m, error, sun_zenith_deg: sun, view_zenith_deg: view, azimuth_deg: azimuth}) =>
          `${percent(error)} ${m === 0 ? 'at the ground' : `from ${m / 1000} km`} (at worst: sun ${
              sun.toFixed(0)}°, view ${view.toFixed(0)}° from the zenith, ${
              azimuth.toFixed(0)}° apart in azimuth)`);
  const sliders = data.sliders.map((slider) => slider.error);
  element('accuracy').textContent =
      `Luminances are those of the model reference within ${
          skies.join(', ')} (sun from 2° and views from 1° above the horizontal on).` +
      (sliders.length ?
           ` Sliders are approximate: each by itself within ${
               percent(Math.max(...sliders))} at the ground, several at once less so.` :
           '');
}

async function start() {
  state.azimuth = state.sunAzimuth + 0.55 * Math.atan(tangent()[0]);  // the sun is in the left half
  readAddress();
  if (matchMedia('(max-width: 640px)').matches)
    element('toggle').setAttribute('aria-expanded', 'false');
  describe();
  listen();
  renderer = new SkyRenderer(element('sky'), data);
  await renderer.load();
  moving = true;
  draw();
  performance.mark('first picture');
  show();
  await renderer.loadSliders();
  addSliders();
  redraw();
}

function fail(reason) {
  element('failure').textContent = `The sky cannot be shown: ${reason}.`;
  element('failure').hidden = false;
}

const ready = start();
ready.catch((error) => fail(error.message));
element('sky').addEventListener(
    'webglcontextlost', () => fail('the device took its graphics back; load the page again'));

window.skyfit = {
  ready,
  // Light from one direction, read from a pixel of 32 bit floats: {luminance_cd_m2,
  // spectral_radiance: [{wavelength_nm, value}]}, the latter in W m^-2 sr^-1 nm^-1. Angles in
  // degrees, zenith angles at the observer, azimuth from the sun's; parameters {name: value}.
  light({sunZenithDeg, viewZenithDeg, azimuthDeg = 0, altitudeM = 0, parameters = {}}) {
    const kept = renderer.parameters;
    renderer.setParameters(
        data.sliders.map((slider, i) => parameters[slider.name] ?? slider.value));
    const light = renderer.lightToward({
      elevation: (90 - viewZenithDeg) * kDegree,
      azimuth: azimuthDeg * kDegree,
      altitude_m: altitudeM,
      sunElevation: (90 - sunZenithDeg) * kDegree,
      sunAzimuth: 0,
    });
    renderer.setParameters(kept);
    return light;
  },
};
