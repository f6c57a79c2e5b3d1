// SPDX-License-Identifier: Apache-2.0
// Numbers, angles and lengths as the page writes them.

function digits(value, count = 3) {
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-3) {
    const power = Math.floor(Math.log10(size));
    const superscript = String(power).replace(/./g, (c) => '⁻⁰¹²³⁴⁵⁶⁷⁸⁹'['-0123456789'.indexOf(c)]);
    return `${(value / 10 ** power).toPrecision(count)}·10${superscript}`;
  }
  return size >= 1000 ? Math.round(value).toLocaleString('en').replace(/,/g, ' ') :
                        value.toPrecision(count);
}

const degrees = (angle, places = 1) => `${(angle / kDegree).toFixed(places).replace('-', '−')}°`;
const length = (m) => (m < 1000 ? `${digits(m, m < 10 ? 2 : 3)} m` : `${digits(m / 1000)} km`);
const quantity = (value, unitName) =>
    (unitName === '1' ? digits(value) :
                        `${digits(value)} ${unitName.replace('1/m', 'm⁻¹').replace('um', 'µm')}`);
const compass = (azimuth) =>
    ['N', 'NE', 'E', 'SE', 'S', 'SW', 'W', 'NW'][Math.round(azimuth / (45 * kDegree)) % 8];
