// lambent.d.ts: the types of lambent.js.

/** Files in memory, by their absolute path. */
export class Files {
  set(path: string, bytes: Uint8Array): void;
  get(path: string): Uint8Array | undefined;
  delete(path: string): boolean;
  list(): string[];
}

/** Thrown if a command line cannot be drawn. `message` is the program's error message. */
export class LambentError extends Error {
  /** Corresponds to the program's exit code: BAD_ARGUMENT, CANNOT_READ, UNSUPPORTED, LIMIT or CANNOT_WRITE. FAILED for any other error. */
  readonly code: string;
  /** True if the caller has cancelled the call. */
  readonly cancelled: boolean;
}

export interface Camera {
  eye: [number, number, number];
  target: [number, number, number];
  up: [number, number, number];
  /** Full vertical field of view in degrees. Used only if `ortho` is 0. */
  fovy_deg: number;
  /** Half the height of an orthographic view in model units. 0 for a perspective view. */
  ortho: number;
  /** The scene's up axis. */
  pole: [number, number, number];
}

export interface Picture {
  width: number;
  height: number;
  /** RGBA, four bytes for each pixel, rows from the top. */
  pixels: Uint8ClampedArray;
  triangles: number;
  read_ms: number;
  frame_ms: number;
  camera: Camera;
  /** The bounding sphere of the scene. */
  sphere: { centre: [number, number, number]; radius: number };
  /** True if the lights of the model's file light the picture. */
  own_lights: boolean;
  /** The diffuse colour of the first object's material, linear. */
  color: [number, number, number];
  warnings: string[];
}

export interface Word {
  name: string;
  summary: string | null;
}

export interface Option {
  /** The option's name without the leading dashes. */
  name: string;
  /** The title of the option's group in the help. */
  group: string;
  /** The placeholder of the option's value. Null if the option has no value. */
  value: string | null;
  default: string | null;
  summary: string;
  /** Synonyms for the search, separated by spaces. */
  others: string | null;
  kind: 'any' | 'file' | 'color' | 'material' | 'light' | 'camera' | 'environment' | 'varied' | 'swept';
  repeats: boolean;
  number: boolean;
  whole: boolean;
  min?: number;
  max?: number;
  words?: Word[];
}

export interface Options {
  version: string;
  shapes: string[];
  /** File name extensions of the models and scene files that the module reads, without the dot: "obj". */
  endings: string[];
  options: Option[];
}

/** Thrown if a divided module needs a part that is not loaded. The Lambent that throws it cannot be used afterwards. */
export class PartMissing extends Error {
  readonly part: 'rest' | 'more' | 'threads-more';
}

export class Lambent {
  /**
   * @param more.parts the loaded parts of a divided module, besides the first part
   * @param more.memory the memory of a module with threads (threads.js)
   * @param more.progress called repeatedly during drawing, with the finished fraction from 0 to 1
   */
  constructor(module: WebAssembly.Module, files?: Files, more?: { parts?: WebAssembly.Module[]; memory?: WebAssembly.Memory | null; progress?: ((share: number) => void) | null });
  /** Adds a part of a divided module. */
  complete(part: WebAssembly.Module): void;
  readonly files: Files;
  /**
   * Limits the memory for reading a model to this number of bytes, and the memory for drawing it to the same number. The limits apply if the words
   * contain no --memory-limit. 0 means no limit.
   */
  limitMemory(bytes: number): void;
  /** Draws the picture of a command line, MODEL [OPTION...]. Throws a LambentError if the picture cannot be drawn. */
  draw(words: string[]): Picture;
  /** Returns the bytes of the picture's file. `ending` is png, jpg, ppm or pfm. */
  save(words: string[], ending: string): Uint8Array;
  /** Returns the scene file that --save-scene writes, as bytes. */
  scene(words: string[]): Uint8Array;
  /** Returns the explanation of one pixel, as `lambent explain --json` prints it. */
  explain(words: string[], x: number, y: number): any;
  /**
   * Returns three curves of a light, with 101 values each: the attenuation at distances from 0 to `farthest`, and the cone and the highlight at angles
   * from 0 to 90 degrees.
   */
  curves(words: string[], of: { light: number; farthest: number; shininess: number; reflection: string }): { type: string; attenuation: number[]; spot: number[]; highlight: number[] };
  /** Returns the picture's lights in the form of a scene file, as `lambent lights` prints them. */
  lights(words: string[]): any;
  /** Returns the model's size and unit, objects with their parts, materials, animations, variants and cameras. */
  contents(words: string[]): any;
  options(): Options;
  /** Forgets the model, so that the next call reads it again. Call it after files have changed. */
  forget(): void;
}

/** Opens the module from its bytes, or from a compiled module. */
export function open(source: BufferSource | WebAssembly.Module): Promise<Lambent>;
