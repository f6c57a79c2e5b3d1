// SPDX-License-Identifier: Apache-2.0
// Look-up tables from the text of the page: the inverse of render/page/table_packing.cc.

async function inflated(base64) {
  const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate-raw'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// The bits of the nearest 16 bit float (IEEE 754 binary16).
const float32 = new Float32Array(1), bits32 = new Uint32Array(float32.buffer);
function half(value) {
  float32[0] = value;
  const bits = bits32[0], sign = (bits >>> 16) & 0x8000, exponent = ((bits >>> 23) & 0xff) - 112;
  if (exponent >= 31) return sign | 0x7c00;
  if (exponent <= 0) return sign | Math.round(Math.abs(value) * 2 ** 24);  // subnormal
  return sign | (((exponent << 10) | ((bits >>> 13) & 0x3ff)) + ((bits >>> 12) & 1));
}

// {width, height, depth, values}: four values to a texel, 16 bit floats as their bits or 32 bit
// floats.
async function decodedTable(packed, asHalves) {
  const {width, height, depth, row, step, offset, logarithm} = packed;
  const bytes = await inflated(packed.texels);
  const texels = width * height * depth, kSteps = 65536;
  const values = asHalves ? new Uint16Array(4 * texels) : new Float32Array(4 * texels);
  const valueOf = asHalves ? new Uint16Array(kSteps) : new Float32Array(kSteps);
  for (let i = 0; i < kSteps; ++i) {
    const held = offset + step * i, value = logarithm ? Math.exp(held) : held;
    valueOf[i] = asHalves ? half(value) : value;
  }
  const steps = new Uint16Array(texels);
  for (let channel = 0; channel < 4; ++channel) {
    const low = channel * texels, high = (4 + channel) * texels;
    for (let texel = 0, line = 0; texel < texels; ++line) {
      const hasAbove = line % height !== 0;
      for (let x = 0; x < width; ++x, ++texel) {
        const folded = bytes[low + texel] | (bytes[high + texel] << 8);
        let value = (folded >>> 1) ^ -(folded & 1);
        const hasLeft = x % row !== 0;
        if (hasLeft) value += steps[texel - 1];
        if (hasAbove) value += steps[texel - width];
        if (hasLeft && hasAbove) value -= steps[texel - width - 1];
        steps[texel] = value;  // modulo 65536
        values[4 * texel + channel] = valueOf[steps[texel]];
      }
    }
  }
  return {width, height, depth, values};
}

async function decodedTables(packed, asHalves) {
  const names = Object.keys(packed);
  const tables = await Promise.all(names.map((name) => decodedTable(packed[name], asHalves)));
  return Object.fromEntries(names.map((name, i) => [name, tables[i]]));
}
