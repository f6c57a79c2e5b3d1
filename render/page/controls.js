// SPDX-License-Identifier: Apache-2.0
// What is shown, how it is drawn, and the controls of the panel.

const element = (id) => document.getElementById(id);
const data = JSON.parse(element('data').textContent);
element('data').remove();

// What is shown. Heights in m, angles in radians; `pitch` is above the horizon that the observer
// sees.
const state = {
  sunElevation: 25 * kDegree,
  sunAzimuth: 180 * kDegree,
  pitch: 13 * kDegree,
  azimuth: 180 * kDegree,
  altitude_m: 2,
  field: 75 * kDegree,
  stops: 0,
};
const kLowestSun = -30 * kDegree;
let renderer, exposure, pointer = null, moving = false;
let resolution = 0.5;  // share of the sides' pixels that is drawn while something moves; the first
                       // picture is such

// ---- places and angles

const radius = data.planet.radius_m;
const dip = () => Math.acos(radius / (radius + state.altitude_m));
const elevation = () => state.pitch - dip();

// Half the field of view along the picture's longer side.
function tangent() {
  const {clientWidth: width, clientHeight: height} = element('sky');
  const longer = Math.tan(state.field / 2), side = Math.max(width, height);
  return [(longer * width) / side, (longer * height) / side];
}

const view = () => ({
  elevation: elevation(),
  azimuth: state.azimuth,
  tangent: tangent(),
  altitude_m: state.altitude_m,
  sunElevation: state.sunElevation,
  sunAzimuth: state.sunAzimuth,
});

const unit = (v) => {
  const length = Math.hypot(...v);
  return v.map((x) => x / length);
};

function directionAt(x, y) {
  const canvas = element('sky'), axes = cameraAxes(elevation(), state.azimuth),
        [tx, ty] = tangent();
  const across = ((2 * x) / canvas.clientWidth - 1) * tx,
        along = (1 - (2 * y) / canvas.clientHeight) * ty;
  return unit([0, 1, 2].map((k) => axes[k] * across + axes[3 + k] * along - axes[6 + k]));
}

// Where a direction lies on the screen, or null behind the camera.
function placeOf(d) {
  const canvas = element('sky'), axes = cameraAxes(elevation(), state.azimuth),
        [tx, ty] = tangent();
  const along = (column) => d.reduce((sum, x, k) => sum + x * axes[3 * column + k], 0),
        depth = -along(2);
  if (depth <= 0.01) return null;
  return [
    0.5 * (along(0) / depth / tx + 1) * canvas.clientWidth,
    0.5 * (1 - along(1) / depth / ty) * canvas.clientHeight
  ];
}

const anglesOf = (d) => ({
  elevation: Math.asin(Math.min(1, Math.max(-1, d[2]))),
  azimuth: (Math.atan2(-d[1], d[0]) + 2 * Math.PI) % (2 * Math.PI)
});
const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

// ---- drawing

// The rule of metered_exposure() (render/sequence/exposure.cc) without its cases of discs and of
// space, which does not count here: the mean logarithm becomes middle grey, a little more in bright
// views, and highlights stay below white. m^2/cd.
function automaticExposure(luminances) {
  const sorted = luminances.sort((a, b) => a - b),
        quantile = (share) => sorted[Math.floor(share * (sorted.length - 1))];
  const highlight = quantile(0.99),
        seen = sorted.filter((luminance) => luminance > 1e-3 * highlight);
  const mean = seen.length ?
      Math.exp(seen.reduce((sum, luminance) => sum + Math.log(luminance), 0) / seen.length) :
      0;
  const level = Math.max(
      mean / (0.18 * (Math.max(mean, 0.02) / 500) ** 0.15), highlight, quantile(0.86) / 0.5);
  return 1 / Math.max(level, 0.02 / 0.18);
}

let requested = false, settled = null;
function redraw() {
  if (requested || !renderer?.textures) return;
  requested = true;
  requestAnimationFrame(() => {
    requested = false;
    draw();
  });
}

// A slow device draws fewer pixels while something moves.
function drawMoving() {
  moving = true;
  clearTimeout(settled);
  settled = setTimeout(() => {
    moving = false;
    redraw();
  }, 200);
  redraw();
}

function draw() {
  const began = performance.now(), canvas = element('sky'), kMostPixels = 1.6e6;
  const {clientWidth: width, clientHeight: height} = canvas;
  const scale = Math.min(devicePixelRatio, Math.sqrt(kMostPixels / (width * height))) *
      (moving ? resolution : 1);
  renderer.resize(Math.max(1, Math.round(width * scale)), Math.max(1, Math.round(height * scale)));
  const wanted = automaticExposure(renderer.luminances(view()));
  exposure = exposure && Math.abs(Math.log(exposure / wanted)) > 0.02 ?
      exposure * (wanted / exposure) ** 0.35 :
      wanted;
  renderer.draw(view(), exposure * 2 ** state.stops);
  measure();
  placeSun();
  if (moving) {
    renderer.finish();
    const spent = performance.now() - began;
    resolution = clamp(resolution * (spent > 60 ? 0.8 : spent < 20 ? 1.25 : 1), 0.3, 1);
  }
  if (exposure !== wanted) redraw();
}

function placeSun() {
  const handle = element('sun'), place = placeOf(direction(state.sunElevation, state.sunAzimuth));
  handle.classList.toggle('seen', place !== null);
  handle.style.pointerEvents = place ? 'auto' : 'none';
  if (place) handle.style.translate = `${place[0]}px ${place[1]}px`;
}

// The colour of a wavelength in the little chart; no more than a label.
const hueOf = (nm) => `hsl(${clamp(((690 - nm) / 240) * 250, 0, 265)} 75% 55%)`;

function measure() {
  if (!pointer) return;
  const canvas = element('sky'), {width, height} = renderer.picture;
  const x = clamp(Math.floor((pointer[0] / canvas.clientWidth) * width), 0, width - 1);
  const y = clamp(Math.floor((1 - pointer[1] / canvas.clientHeight) * height), 0, height - 1);
  const light = renderer.lightAt(x, y), at = anglesOf(directionAt(...pointer));
  element('probe').classList.add('measured');
  element('luminance').textContent = digits(light.luminance_cd_m2);
  element('aim').textContent = `${degrees(at.elevation)} above the horizontal, azimuth ${
      degrees(at.azimuth)} (${compass(at.azimuth)})`;
  const most = Math.max(...light.spectral_radiance.map((s) => s.value), 1e-30);
  element('spectrum')
      .replaceChildren(
          textElement('span', 'W m⁻² sr⁻¹ nm⁻¹', 'head'),
          ...light.spectral_radiance.flatMap(({wavelength_nm: nm, value}) => {
            const bar = document.createElement('i');
            bar.style.width = `${(100 * value) / most}%`;
            bar.style.background = hueOf(nm);
            return [
              textElement('span', `${Math.round(nm)} nm`), bar, textElement('span', digits(value))
            ];
          }));
}

function textElement(kind, text, style = '') {
  const made = document.createElement(kind);
  made.textContent = text;
  made.className = style;
  return made;
}

// ---- controls

// Altitudes from 0 to six radii: nearly even in the logarithm from 10 m on.
const kNearest_m = 10, kFarthest_m = 6 * radius, kDecades = Math.log(1 + kFarthest_m / kNearest_m);
const altitudeFrom = (x) => kNearest_m * (Math.exp(x * kDecades) - 1);
const altitudeTo = (m) => Math.log(1 + m / kNearest_m) / kDecades;

const controls = [
  {
    id: 'sun-height',
    get: () => state.sunElevation / kDegree,
    set: (x) => {
      state.sunElevation = x * kDegree;
    },
    text: () => degrees(state.sunElevation)
  },
  {
    id: 'sun-azimuth',
    get: () => state.sunAzimuth / kDegree,
    set: (x) => {
      state.sunAzimuth = x * kDegree;
    },
    text: () => `${degrees(state.sunAzimuth)} ${compass(state.sunAzimuth)}`
  },
  {
    id: 'altitude',
    get: () => altitudeTo(state.altitude_m),
    set: (x) => {
      state.altitude_m = altitudeFrom(x);
    },
    text: () => length(state.altitude_m)
  },
  {
    id: 'field',
    get: () => state.field / kDegree,
    set: (x) => {
      state.field = x * kDegree;
    },
    text: () => degrees(state.field, 0)
  },
  {
    id: 'exposure',
    get: () => state.stops,
    set: (x) => {
      state.stops = x;
    },
    text: () => `${state.stops >= 0 ? '+' : '−'}${Math.abs(state.stops).toFixed(1)} EV`
  },
];

function show() {
  for (const {id, get, text} of controls) {
    element(id).value = get();
    element(`${id}-value`).textContent = text();
  }
  element('place').textContent =
      `sun ${degrees(state.sunElevation)} high, from ${length(state.altitude_m)}`;
  keepAddress();
  drawMoving();
}

// The state in the address, so that a link leads to what is seen.
const kAddress = {
  sun: ['sunElevation', kDegree],
  sunaz: ['sunAzimuth', kDegree],
  pitch: ['pitch', kDegree],
  az: ['azimuth', kDegree],
  alt: ['altitude_m', 1],
  fov: ['field', kDegree],
  ev: ['stops', 1]
};
let addressTimer = null;
function keepAddress() {
  clearTimeout(addressTimer);
  addressTimer = setTimeout(() => {
    const parts = Object.entries(kAddress).map(
        ([key, [name, scale]]) => `${key}=${+ (state[name] / scale).toPrecision(5)}`);
    history.replaceState(null, '', `#${parts.join('&')}`);
  }, 300);
}
function readAddress() {
  for (const [key, text] of new URLSearchParams(location.hash.slice(1))) {
    const value = Number(text);
    if (key in kAddress && text !== '' && Number.isFinite(value))
      state[kAddress[key][0]] = value * kAddress[key][1];
  }
  state.altitude_m = clamp(state.altitude_m, 0, kFarthest_m);
  state.field = clamp(state.field, 5 * kDegree, 120 * kDegree);
}
