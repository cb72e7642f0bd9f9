// painter.js: draws with WebGL 2 for the module of checks, through the functions that painter.c imports. The pixels of pictures are floats if the browser can
// draw to floats (EXT_color_buffer_float). Otherwise they are bytes.

// Maps GLSL types to lam_check_type.
const TYPES = new Map([['FLOAT', 1], ['INT', 2], ['BOOL', 3], ['FLOAT_VEC2', 4], ['FLOAT_VEC3', 5], ['FLOAT_VEC4', 6], ['FLOAT_MAT3', 7], ['FLOAT_MAT4', 8],
  ['SAMPLER_2D', 9]]);
// The numbers of columns and rows of each lam_check_type.
const SHAPES = [[0, 0], [1, 1], [1, 1], [1, 1], [1, 2], [1, 3], [1, 4], [3, 3], [4, 4], [1, 4]];
const NONE = 0, FRONT = 2; // of lam_check_cull

export class Painter {
  #gl = null;
  #types = new Map();
  #floats = false;
  #places = new Map();
  #programs = new Map();
  #next = 1;
  #memory = null;
  #canvas;

  // `canvas()` creates a canvas. In a worker it creates an OffscreenCanvas.
  constructor(canvas) {
    this.#canvas = canvas;
  }

  attach(instance) {
    this.#memory = instance.exports.memory;
  }

  // Returns the imports of the module.
  get imports() {
    const call = (name) => (...all) => this[name](...all);
    return Object.fromEntries(['open', 'close', 'compile', 'input_count', 'input', 'forget', 'mesh', 'value', 'stream', 'draw'].map((name) => [name, call(name)]));
  }

  #text(at) {
    const bytes = new Uint8Array(this.#memory.buffer, at), end = bytes.indexOf(0);
    return new TextDecoder().decode(bytes.slice(0, end));
  }

  // Writes a text with a terminating 0. If the text is too long, it is cut off between two characters.
  #write(at, capacity, text) {
    const bytes = new Uint8Array(this.#memory.buffer, at, capacity);
    const { written } = new TextEncoder().encodeInto(text ?? '', bytes.subarray(0, capacity - 1));
    bytes[written] = 0;
  }

  #floatsAt(at, count) {
    return new Float32Array(this.#memory.buffer, at, count);
  }

  // --- render targets

  #start() {
    if (this.#gl && !this.#gl.isContextLost()) return '';
    const gl = this.#canvas().getContext('webgl2', { antialias: false, depth: false, preserveDrawingBuffer: false, powerPreference: 'high-performance' });
    if (!gl) return 'this browser has no WebGL 2, which draws the shaders';
    this.#gl = gl;
    this.#floats = gl.getExtension('EXT_color_buffer_float') !== null;
    this.#types = new Map([...TYPES].map(([name, number]) => [gl[name], number]));
    gl.bindVertexArray(gl.createVertexArray());
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LESS);
    gl.disable(gl.BLEND);
    gl.disable(gl.DITHER);
    gl.clearColor(0, 0, 0, 0);
    gl.pixelStorei(gl.PACK_ALIGNMENT, 4);
    return '';
  }

  open(size, renderer, capacity) {
    const refused = this.#start(), gl = this.#gl;
    if (refused) {
      this.#write(renderer, capacity, refused);
      return 0;
    }
    const place = { size, framebuffer: gl.createFramebuffer(), color: gl.createRenderbuffer(), depth: gl.createRenderbuffer(), meshes: new Map() };
    gl.bindFramebuffer(gl.FRAMEBUFFER, place.framebuffer);
    gl.bindRenderbuffer(gl.RENDERBUFFER, place.color);
    gl.renderbufferStorage(gl.RENDERBUFFER, this.#floats ? gl.RGBA32F : gl.RGBA8, size, size);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.RENDERBUFFER, place.color);
    gl.bindRenderbuffer(gl.RENDERBUFFER, place.depth);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, size, size);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, place.depth);
    const about = gl.getExtension('WEBGL_debug_renderer_info');
    this.#write(renderer, capacity, gl.getParameter(about ? about.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
    this.#places.set(this.#next, place);
    return this.#next++;
  }

  close(number) {
    const gl = this.#gl, place = this.#places.get(number);
    for (const buffers of place.meshes.values()) for (const buffer of Object.values(buffers)) gl.deleteBuffer(buffer);
    gl.deleteFramebuffer(place.framebuffer);
    gl.deleteRenderbuffer(place.color);
    gl.deleteRenderbuffer(place.depth);
    this.#places.delete(number);
  }

  // --- programs

  #shader(kind, text) {
    const gl = this.#gl, shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    return { shader, good: gl.getShaderParameter(shader, gl.COMPILE_STATUS), log: gl.getShaderInfoLog(shader) };
  }

  compile(place, vertexText, fragmentText, refused, vertexLog, fragmentLog, linkLog, capacity) {
    const gl = this.#gl;
    const vertex = this.#shader(gl.VERTEX_SHADER, this.#text(vertexText)), fragment = this.#shader(gl.FRAGMENT_SHADER, this.#text(fragmentText));
    this.#write(vertexLog, capacity, vertex.log);
    this.#write(fragmentLog, capacity, fragment.log);
    new Int32Array(this.#memory.buffer, refused, 1)[0] = (vertex.good ? 0 : 1) | (fragment.good ? 0 : 2);
    let program = null;
    if (vertex.good && fragment.good) {
      program = gl.createProgram();
      gl.attachShader(program, vertex.shader);
      gl.attachShader(program, fragment.shader);
      gl.linkProgram(program);
      const good = gl.getProgramParameter(program, gl.LINK_STATUS);
      this.#write(linkLog, capacity, gl.getProgramInfoLog(program));
      if (!good) {
        gl.deleteProgram(program);
        program = null;
      }
    }
    gl.deleteShader(vertex.shader);
    gl.deleteShader(fragment.shader);
    if (!program) return 0;
    this.#programs.set(this.#next, this.#describe(program));
    return this.#next++;
  }

  #describe(program) {
    const gl = this.#gl, inputs = [], blocks = [];
    const uniforms = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS), attributes = gl.getProgramParameter(program, gl.ACTIVE_ATTRIBUTES);
    const all = [...Array(uniforms).keys()];
    const ask = (what) => (uniforms ? gl.getActiveUniforms(program, all, what) : []);
    const inBlock = ask(gl.UNIFORM_BLOCK_INDEX), offsets = ask(gl.UNIFORM_OFFSET), strides = ask(gl.UNIFORM_ARRAY_STRIDE), columns = ask(gl.UNIFORM_MATRIX_STRIDE);
    for (const i of all) {
      const { name, type, size } = gl.getActiveUniform(program, i);
      inputs.push({ name, size, kind: this.#types.get(type) ?? 0, type, attribute: false, block: inBlock[i], offset: offsets[i], stride: strides[i], columns: columns[i], places: [] });
    }
    for (let i = 0; i < attributes; i++) {
      const { name, type, size } = gl.getActiveAttrib(program, i);
      inputs.push({ name, size, kind: this.#types.get(type) ?? 0, type, attribute: true, location: gl.getAttribLocation(program, name) });
    }
    for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORM_BLOCKS); i++) {
      blocks.push({ buffer: gl.createBuffer(), bytes: new ArrayBuffer(gl.getActiveUniformBlockParameter(program, i, gl.UNIFORM_BLOCK_DATA_SIZE)) });
      gl.uniformBlockBinding(program, i, i);
    }
    return { program, inputs, blocks, textures: [], units: 0, streams: [] };
  }

  input_count(number) {
    return this.#programs.get(number).inputs.length;
  }

  input(number, index, name, capacity, numbers) {
    const input = this.#programs.get(number).inputs[index];
    this.#write(name, capacity, input.name);
    new Int32Array(this.#memory.buffer, numbers, 3).set([input.kind, input.size, input.attribute ? 1 : 0]);
  }

  forget(number) {
    const gl = this.#gl, { program, blocks, textures } = this.#programs.get(number);
    gl.deleteProgram(program);
    for (const { buffer } of blocks) gl.deleteBuffer(buffer);
    for (const texture of textures) gl.deleteTexture(texture);
    this.#programs.delete(number);
  }

  // --- values

  // Returns the location of element `index` of a uniform.
  #location(own, input, index) {
    const name = input.size > 1 || input.name.endsWith('[0]') ? input.name.replace(/\[0\]$/, '') + `[${index}]` : input.name;
    return (input.places[index] ??= this.#gl.getUniformLocation(own.program, name));
  }

  value(number, index, first, count, at) {
    const gl = this.#gl, own = this.#programs.get(number), input = own.inputs[index], [columns, rows] = SHAPES[input.kind];
    const v = this.#floatsAt(at, count * columns * rows);
    gl.useProgram(own.program);
    if (input.block >= 0) this.#store(own.blocks[input.block].bytes, input, first, count, v);
    else if (input.type === gl.SAMPLER_2D) for (let k = 0; k < count; k++) this.#sampler(own, this.#location(own, input, first + k), v.slice(4 * k, 4 * k + 4));
    else {
      const location = this.#location(own, input, first);
      if (input.type === gl.FLOAT_MAT3) gl.uniformMatrix3fv(location, false, v);
      else if (input.type === gl.FLOAT_MAT4) gl.uniformMatrix4fv(location, false, v);
      else if (input.type === gl.INT || input.type === gl.BOOL) gl.uniform1iv(location, Int32Array.from(v));
      else gl[`uniform${rows}fv`](location, v);
    }
  }

  // Sets the values of an attribute for the next picture of a program.
  stream(number, index, components, vertices, at) {
    this.#programs.get(number).streams.push({ index, components, data: this.#floatsAt(at, vertices * components).slice() });
  }

  #store(block, input, first, count, v) {
    const [columns, rows] = SHAPES[input.kind], whole = input.kind === 2 || input.kind === 3, view = new DataView(block);
    for (let k = 0; k < count; k++)
      for (let c = 0; c < columns; c++)
        for (let r = 0; r < rows; r++) {
          const at = input.offset + (first + k) * input.stride + c * input.columns + 4 * r, x = v[(k * columns + c) * rows + r];
          if (whole) view.setInt32(at, x, true);
          else view.setFloat32(at, x, true);
        }
  }

  // Binds a texture of one texel.
  #sampler(own, location, color) {
    const gl = this.#gl, unit = own.units++;
    own.textures[unit] ??= gl.createTexture();
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, own.textures[unit]);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, 1, 1, 0, gl.RGBA, gl.FLOAT, color);
    gl.uniform1i(location, unit);
  }

  // --- drawing

  mesh(number, mesh, vertices, indexCount, positions, normals, tangents, indices) {
    const gl = this.#gl, place = this.#places.get(number);
    if (place.meshes.has(mesh)) return;
    const buffer = (target, data) => {
      const made = gl.createBuffer();
      gl.bindBuffer(target, made);
      gl.bufferData(target, data, gl.STATIC_DRAW);
      return made;
    };
    place.meshes.set(mesh, {
      positions: buffer(gl.ARRAY_BUFFER, this.#floatsAt(positions, vertices * 3)),
      normals: buffer(gl.ARRAY_BUFFER, this.#floatsAt(normals, vertices * 4)),
      tangents: buffer(gl.ARRAY_BUFFER, this.#floatsAt(tangents, vertices * 3)),
      indices: buffer(gl.ELEMENT_ARRAY_BUFFER, new Uint16Array(this.#memory.buffer, indices, indexCount)),
    });
  }

  draw(number, programNumber, mesh, indexCount, position, normal, tangent, cull, pixels) {
    const gl = this.#gl, place = this.#places.get(number), own = this.#programs.get(programNumber), buffers = place.meshes.get(mesh), size = place.size;
    gl.useProgram(own.program);
    own.units = 0;
    own.blocks.forEach(({ buffer, bytes }, i) => {
      gl.bindBufferBase(gl.UNIFORM_BUFFER, i, buffer);
      gl.bufferData(gl.UNIFORM_BUFFER, bytes, gl.STATIC_DRAW);
      new Uint8Array(bytes).fill(0);
    });
    gl.bindFramebuffer(gl.FRAMEBUFFER, place.framebuffer);
    gl.viewport(0, 0, size, size);
    const used = [];
    for (const [index, buffer, width] of [[position, buffers.positions, 3], [normal, buffers.normals, 4], [tangent, buffers.tangents, 3]])
      if (index >= 0) {
        used.push(own.inputs[index].location);
        gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
        gl.enableVertexAttribArray(used.at(-1));
        gl.vertexAttribPointer(used.at(-1), width, gl.FLOAT, false, 0, 0);
      }
    const lent = own.streams.splice(0).map(({ index, components, data }) => {
      const buffer = gl.createBuffer();
      used.push(own.inputs[index].location);
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
      gl.enableVertexAttribArray(used.at(-1));
      gl.vertexAttribPointer(used.at(-1), components, gl.FLOAT, false, 0, 0);
      return buffer;
    });
    if (cull === NONE) gl.disable(gl.CULL_FACE);
    else gl.enable(gl.CULL_FACE);
    gl.cullFace(cull === FRONT ? gl.FRONT : gl.BACK);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffers.indices);
    gl.drawElements(gl.TRIANGLES, indexCount, gl.UNSIGNED_SHORT, 0);
    const rows = this.#floats ? new Float32Array(4 * size * size) : new Uint8Array(4 * size * size);
    gl.readPixels(0, 0, size, size, gl.RGBA, this.#floats ? gl.FLOAT : gl.UNSIGNED_BYTE, rows);
    for (const location of used) gl.disableVertexAttribArray(location);
    for (const buffer of lent) gl.deleteBuffer(buffer);
    const wrong = gl.getError();
    if (gl.isContextLost()) return -1;
    const out = this.#floatsAt(pixels, 4 * size * size), row = 4 * size; // WebGL's first row is the bottom row
    for (let y = 0; y < size; y++) {
      const from = rows.subarray((size - 1 - y) * row, (size - y) * row);
      if (this.#floats) out.set(from, y * row);
      else for (let i = 0; i < row; i++) out[y * row + i] = from[i] / 255;
    }
    return wrong;
  }
}
