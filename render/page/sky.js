// SPDX-License-Identifier: Apache-2.0
// The sky in WebGL 2. Directions are unit vectors x north, y west, z up at the observer; angles in
// radians.

const kDegree = Math.PI / 180;

// Of an elevation above the horizontal and an azimuth clockwise from north.
function direction(elevation, azimuth) {
  const c = Math.cos(elevation);
  return [c * Math.cos(azimuth), -c * Math.sin(azimuth), Math.sin(elevation)];
}

// Right, up and back of a camera that looks that way, as the columns of a matrix.
function cameraAxes(elevation, azimuth) {
  const forward = direction(elevation, azimuth),
        right = [-Math.sin(azimuth), -Math.cos(azimuth), 0];
  const up = direction(elevation + Math.PI / 2, azimuth);
  return [...right, ...up, ...forward.map((x) => -x)];
}

class SkyRenderer {
  // `data`: what render/page/sky_page.cc writes. Throws Error with one line where the browser
  // cannot draw it.
  constructor(canvas, data) {
    if (!('DecompressionStream' in window))
      throw new Error('this browser is too old to decompress data (DecompressionStream)');
    this.canvas = canvas;
    this.data = data;
    const gl = canvas.getContext(
        'webgl2', {antialias: false, alpha: false, powerPreference: 'high-performance'});
    if (!gl) throw new Error('this browser offers no WebGL 2');
    if (!gl.getExtension('EXT_color_buffer_float'))
      throw new Error(
          'this device cannot draw into pictures of 32 bit floats (EXT_color_buffer_float)');
    this.gl = gl;
    this.skyProgram = this.program(data.shaders.vertex, data.shaders.sky);
    this.displayProgram = this.program(data.shaders.vertex, data.shaders.display);
    gl.bindVertexArray(gl.createVertexArray());
    this.picture = this.target(1, 1);
    this.pixel = this.target(1, 1);
    this.parameters = data.sliders.map((slider) => slider.value);
  }

  // Is not asked for its state before it is used, so that programs are compiled while tables are
  // decoded.
  program(vertex, fragment) {
    const gl = this.gl, program = gl.createProgram();
    for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    return {program, uniforms: new Map()};
  }

  use(program) {
    const gl = this.gl;
    if (!program.checked && !gl.getProgramParameter(program.program, gl.LINK_STATUS)) {
      const logs =
          gl.getAttachedShaders(program.program).map((shader) => gl.getShaderInfoLog(shader));
      throw new Error(
          `a shader does not compile: ${logs.join(' ') || gl.getProgramInfoLog(program.program)}`);
    }
    program.checked = true;
    gl.useProgram(program.program);
    return (name) => {
      if (!program.uniforms.has(name))
        program.uniforms.set(name, gl.getUniformLocation(program.program, name));
      return program.uniforms.get(name);
    };
  }

  // Light and disc of a picture.
  target(width, height) {
    const gl = this.gl, framebuffer = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
    const textures = [gl.COLOR_ATTACHMENT0, gl.COLOR_ATTACHMENT1].map((attachment) => {
      const texture = gl.createTexture();
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA32F, width, height);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, attachment, gl.TEXTURE_2D, texture, 0);
      return texture;
    });
    gl.drawBuffers([gl.COLOR_ATTACHMENT0, gl.COLOR_ATTACHMENT1]);
    return {width, height, framebuffer, textures};
  }

  resize(width, height) {
    if (this.picture.width === width && this.picture.height === height) return;
    this.picture.textures.forEach((texture) => this.gl.deleteTexture(texture));
    this.gl.deleteFramebuffer(this.picture.framebuffer);
    this.picture = this.target(width, height);
    this.canvas.width = width;
    this.canvas.height = height;
  }

  // 16 bit floats, which every device can interpolate.
  texture({width, height, depth, values}, is3d) {
    const gl = this.gl, kind = is3d ? gl.TEXTURE_3D : gl.TEXTURE_2D, texture = gl.createTexture();
    const type = values instanceof Uint16Array ? gl.HALF_FLOAT : gl.FLOAT;
    gl.bindTexture(kind, texture);
    if (is3d) {
      gl.texImage3D(kind, 0, gl.RGBA16F, width, height, depth, 0, gl.RGBA, type, values);
    } else {
      gl.texImage2D(kind, 0, gl.RGBA16F, width, height, 0, gl.RGBA, type, values);
    }
    gl.texParameteri(kind, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    gl.texParameteri(kind, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
    for (const axis of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T, gl.TEXTURE_WRAP_R])
      gl.texParameteri(kind, axis, gl.CLAMP_TO_EDGE);
    return {kind, texture};
  }

  static is3d(name) {
    return name === 'rayleigh_like' || name === 'single';
  }

  async load() {
    const tables = await decodedTables(this.data.tables, true);
    this.textures = Object.fromEntries(Object.entries(tables).map(
        ([name, table]) => [name, this.texture(table, SkyRenderer.is3d(name))]));
    this.changes = {};
    for (const name of Object.keys(tables)) {
      const none = {width: 1, height: 1, depth: 1, values: new Float32Array(4)};
      this.changes[name] = this.texture(none, SkyRenderer.is3d(name));
    }
    this.uniforms = structuredClone(this.data.uniforms);
  }

  // The changes by the sliders, which the first picture does not need.
  async loadSliders() {
    for (const slider of this.data.sliders) {
      for (const change of slider.changes)
        change.decoded = await decodedTables(change.tables, false);
    }
    this.setParameters(this.parameters);
  }

  // The shares of a slider's changes that stand for a value: change_shares() of
  // render/page/page_sliders.cc.
  static changeShares(slider, value) {
    const even = (x) => (slider.logarithmic ? Math.log(x / slider.value) : x - slider.value);
    const at = even(value), [a, b] = slider.changes.map((change) => even(change.value));
    return [(at * (at - b)) / (a * (a - b)), (at * (at - a)) / (b * (b - a))];
  }

  // One value to each slider, in the unit of its parameter.
  setParameters(values) {
    const gl = this.gl, {sliders, uniforms} = this.data;
    this.parameters = [...values];
    this.uniforms = structuredClone(uniforms);
    const sums = {};
    sliders.forEach((slider, i) => {
      const shares = SkyRenderer.changeShares(slider, values[i]);
      slider.changes.forEach((change, c) => {
        for (const [name, table] of Object.entries(change.decoded)) {
          sums[name] ??= {...table, values: new Float32Array(table.values.length)};
          const sum = sums[name].values, share = shares[c];
          if (share !== 0)
            for (let k = 0; k < sum.length; ++k) sum[k] += share * table.values[k];
        }
      });
      // What is no table is linear in the parameter.
      const change = slider.changes[1],
            share = (values[i] - slider.value) / (change.value - slider.value);
      const add = (to, from, before) => to.map((x, k) => x + share * (from[k] - before[k]));
      this.uniforms.ground_albedo =
          add(this.uniforms.ground_albedo, change.uniforms.ground_albedo, uniforms.ground_albedo);
      this.uniforms.phase_parameters = this.uniforms.phase_parameters.map(
          (phase, c) =>
              add(phase, change.uniforms.phase_parameters[c], uniforms.phase_parameters[c]));
    });
    for (const [name, sum] of Object.entries(sums)) {
      gl.deleteTexture(this.changes[name].texture);
      this.changes[name] = this.texture(sum, SkyRenderer.is3d(name));
    }
  }

  bindTextures(textures, uniform) {
    const gl = this.gl;
    textures.forEach(([name, {kind, texture}], unit) => {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(kind, texture);
      gl.uniform1i(uniform(name), unit);
    });
  }

  setView(view, uniform) {
    const gl = this.gl;
    gl.uniformMatrix3fv(uniform('site_from_view'), false, cameraAxes(view.elevation, view.azimuth));
    gl.uniform2fv(uniform('tangent'), view.tangent);
    gl.uniform1f(uniform('camera_km'), 1e-3 * view.altitude_m);
    gl.uniform4fv(uniform('suns'), [...direction(view.sunElevation, view.sunAzimuth), 1]);
  }

  // view: {elevation, azimuth, tangent: half the field of view across and along, altitude_m,
  // sunElevation, sunAzimuth}.
  drawLight(target, view) {
    const gl = this.gl, uniform = this.use(this.skyProgram);
    this.setView(view, uniform);
    gl.uniform1f(uniform('depolarisation'), this.uniforms.depolarisation);
    gl.uniform4fv(uniform('phase_parameters'), this.uniforms.phase_parameters.flat());
    gl.uniform4fv(uniform('ground_albedo'), this.uniforms.ground_albedo);
    this.bindTextures(
        [
          ...Object.entries(this.textures).map(([name, texture]) => [`${name}_table`, texture]),
          ...Object.entries(this.changes).map(([name, texture]) => [`${name}_change`, texture])
        ],
        uniform);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target.framebuffer);
    gl.viewport(0, 0, target.width, target.height);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  // exposure: m^2/cd.
  draw(view, exposure) {
    const gl = this.gl;
    this.drawLight(this.picture, view);
    const uniform = this.use(this.displayProgram);
    this.setView(view, uniform);
    const xyz = this.data.xyz_from_nodes;
    gl.uniformMatrix4fv(
        uniform('xyz_from_nodes'), false,
        [0, 1, 2, 3].flatMap((node) => [...xyz.map((row) => row[node]), 0]));
    gl.uniform1f(uniform('exposure'), exposure);
    const [light, disc] = this.picture.textures.map((texture) => ({kind: gl.TEXTURE_2D, texture}));
    this.bindTextures([['light_picture', light], ['disc_picture', disc]], uniform);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, this.picture.width, this.picture.height);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  // Waits until what was asked for is drawn.
  finish() {
    const gl = this.gl;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }

  read(target, x, y, width, height, attachment) {
    const gl = this.gl, values = new Float32Array(4 * width * height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target.framebuffer);
    gl.readBuffer(attachment);
    gl.readPixels(x, y, width, height, gl.RGBA, gl.FLOAT, values);
    return values;
  }

  luminanceOf(nodes) {
    return this.data.xyz_from_nodes[1].reduce((sum, weight, k) => sum + weight * nodes[k], 0);
  }

  // A pixel of the picture's floats, from below left: luminance (cd/m^2) and spectral radiance at
  // the four wavelengths (W m^-2 sr^-1 nm^-1) without the sun's disc.
  lightAt(x, y, target = this.picture) {
    const nodes = this.read(target, x, y, 1, 1, this.gl.COLOR_ATTACHMENT0);
    return {
      luminance_cd_m2: this.luminanceOf(nodes),
      spectral_radiance: this.data.nodes.map(
          (node, k) => ({wavelength_nm: node.wavelength_nm, value: node.irradiance * nodes[k]})),
    };
  }

  // The same of one direction, drawn into a picture of one pixel.
  lightToward(view) {
    this.drawLight(this.pixel, {...view, tangent: [1e-6, 1e-6]});
    return this.lightAt(0, 0, this.pixel);
  }

  // Luminances of a small picture of the view, cd/m^2.
  luminances(view) {
    this.meter ??= this.target(24, 24);
    this.drawLight(this.meter, view);
    const nodes = this.read(this.meter, 0, 0, 24, 24, this.gl.COLOR_ATTACHMENT0);
    return Array.from(
        {length: nodes.length / 4}, (_, i) => this.luminanceOf(nodes.subarray(4 * i, 4 * i + 4)));
  }
}
