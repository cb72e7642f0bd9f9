// decoders.js: runs the module that decodes Draco and meshoptimizer data (web/decoders.py). A Lambent uses this module if a file needs it. The Lambent's module
// and this module have separate memories.
import { Files, system } from './wasi.js';

const SIZES = { 5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4 }; // bytes of glTF's component types
const REASON_BYTES = 160;

export class Decoders {
  #exports;
  #draco; // exports of draco_functions: decode, attribute, triangles, free
  #meshes = new Map();

  constructor(module) {
    const host = system(new Files(), [], () => {}), instance = new WebAssembly.Instance(module, { wasi_snapshot_preview1: host.wasi_snapshot_preview1 });
    host.attach(instance);
    this.#exports = instance.exports;
    this.#exports._initialize();
    const at = this.#exports.lambent_draco_functions(), table = this.#exports.__indirect_function_table;
    this.#draco = [...new Uint32Array(this.#exports.memory.buffer, at, 5)].slice(1).map((index) => table.get(index));
  }

  #bytes = (at, size) => new Uint8Array(this.#exports.memory.buffer, at, size);

  // Calls `act` with memory of this module, one block for each size. Returns null if `act` traps.
  #within(sizes, act) {
    const { malloc, free } = this.#exports, places = sizes.map((size) => malloc(size));
    try {
      return places.includes(0) ? null : act(...places);
    } catch (error) {
      if (!(error instanceof WebAssembly.RuntimeError)) throw error;
      return null;
    } finally {
      for (const place of places) free(place);
    }
  }

  // Returns the functions that the Lambent's module imports. `own(at, size)` returns bytes of the memory of the Lambent's module.
  imports(own) {
    const [decode, attribute, triangles, free] = this.#draco, put = (to, from, size) => own(to, size).set(this.#bytes(from, size));
    return {
      web_draco_decode: (bytes, size, out, reason) =>
        this.#within([size, 12, REASON_BYTES], (input, facts, why) => {
          this.#bytes(input, size).set(own(bytes, size));
          const result = decode(input, size, 0, facts, facts + 4, facts + 8, why);
          const mesh = new Uint32Array(this.#exports.memory.buffer, facts, 3).slice(); // address, vertices and triangles of the mesh
          if (result > 0) this.#meshes.set(mesh[0], mesh);
          put(out, facts, 12);
          if (!result) put(reason, why, REASON_BYTES);
          return result;
        }) ?? 0,
      web_draco_attribute: (mesh, id, component, width, out, reason) => {
        const size = this.#meshes.get(mesh)[1] * width * SIZES[component];
        return this.#within([size, REASON_BYTES], (place, why) => {
          const result = attribute(mesh, id, component, width, place, why);
          put(result > 0 ? out : reason, result > 0 ? place : why, result > 0 ? size : REASON_BYTES);
          return result;
        }) ?? 0;
      },
      web_draco_triangles: (mesh, out) => {
        const size = 12 * this.#meshes.get(mesh)[2];
        this.#within([size], (place) => {
          triangles(mesh, place);
          put(out, place, size);
        });
      },
      web_draco_free: (mesh) => {
        free(mesh);
        this.#meshes.delete(mesh);
      },
      web_meshopt_decode: (kind, out, count, stride, bytes, size) =>
        this.#within([count * stride, size], (place, input) => {
          this.#bytes(input, size).set(own(bytes, size));
          const result = this.#exports[`meshopt_decode${['VertexBuffer', 'IndexBuffer', 'IndexSequence'][kind]}`](place, count, stride, input, size);
          put(out, place, count * stride);
          return result;
        }) ?? 1,
      web_meshopt_filter: (kind, data, count, stride) => {
        this.#within([count * stride], (place) => {
          this.#bytes(place, count * stride).set(own(data, count * stride));
          this.#exports[`meshopt_decodeFilter${['Oct', 'Quat', 'Exp'][kind]}`](place, count, stride);
          put(data, place, count * stride);
        });
      },
    };
  }
}
