// SPDX-License-Identifier: Apache-2.0
// Look-up tables from the text of the page: the inverse of render/page/table_packing.cc.

async function inflated(base64) {
  const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate-raw'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// {width, height, depth, values}: four values to a texel.
async function decodedTable(packed) {
  const { width, height, depth, row, step, offset } = packed;
  const bytes = await inflated(packed.texels);
  const texels = width * height * depth;
  const values = new Float32Array(4 * texels);
  const steps = new Int32Array(texels);
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
        steps[texel] = value & 0xffff;
        const held = offset + step * steps[texel];
        values[4 * texel + channel] = packed.logarithm ? Math.exp(held) : held;
      }
    }
  }
  return { width, height, depth, values };
}

async function decodedTables(packed) {
  const names = Object.keys(packed);
  const tables = await Promise.all(names.map((name) => decodedTable(packed[name])));
  return Object.fromEntries(names.map((name, i) => [name, tables[i]]));
}
