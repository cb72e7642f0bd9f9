// lambent.d.ts: the types of lambent.js.

/** Files in memory, by their absolute path. */
export class Files {
  set(path: string, bytes: Uint8Array): void;
  get(path: string): Uint8Array | undefined;
  delete(path: string): boolean;
  list(): string[];
}

/** A command line that cannot be drawn: the program's own sentence. */
export class LambentError extends Error {
  /** By the program's exit codes: BAD_ARGUMENT, CANNOT_READ, UNSUPPORTED, LIMIT, CANNOT_WRITE; FAILED for others. */
  readonly code: string;
  /** The call was asked to end. */
  readonly cancelled: boolean;
}

export interface Camera {
  eye: [number, number, number];
  target: [number, number, number];
  up: [number, number, number];
  /** Full vertical field of view in degrees; counts where `ortho` is 0. */
  fovy_deg: number;
  /** Half the height of an orthographic view in model units; 0: perspective. */
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
  /** Lights of the model's file light the picture. */
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
  /** Without the dashes. */
  name: string;
  /** The title of its group in the help. */
  group: string;
  /** The placeholder of its value; null: it takes none. */
  value: string | null;
  default: string | null;
  summary: string;
  details: string | null;
  /** Other names that people try, separated by spaces. */
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
  /** Of models and scene files that are read: "obj", without the point. */
  endings: string[];
  options: Option[];
}

/** A part of a module in parts is needed that is not there; this Lambent is of no use any more. */
export class PartMissing extends Error {
  readonly part: 'rest' | 'more';
}

export class Lambent {
  /** `parts`: of a module in parts; `memory`: of a module with threads (threads.js); `progress`: gets the share that is drawn, 0 to 1. */
  constructor(module: WebAssembly.Module, files?: Files, more?: { parts?: WebAssembly.Module[]; memory?: WebAssembly.Memory | null; progress?: ((share: number) => void) | null });
  /** A part of a module in parts. */
  complete(part: WebAssembly.Module): void;
  readonly files: Files;
  /** Limits the memory of reading a model and of drawing it, in bytes each, if the words have no --memory-limit. 0 means no limit. */
  limitMemory(bytes: number): void;
  /** The picture of a command line, MODEL [OPTION...]. Throws LambentError. */
  draw(words: string[]): Picture;
  /** The bytes of its file: png, jpg, ppm or pfm. */
  save(words: string[], ending: string): Uint8Array;
  /** The scene file that --save-scene writes. */
  scene(words: string[]): Uint8Array;
  /** One pixel, in the form of `lambent explain --json`. */
  explain(words: string[], x: number, y: number): any;
  /** A light's laws: 101 values each, from 0 to `farthest`, and from 0 to 90 degrees. */
  curves(words: string[], of: { light: number; farthest: number; shininess: number; reflection: string }): { type: string; attenuation: number[]; spot: number[]; highlight: number[] };
  /** The picture's lights in the form of a scene file, as `lambent lights` prints them. */
  lights(words: string[]): any;
  /** Returns the model's size and unit, objects with their parts, materials, animations, variants and cameras. */
  contents(words: string[]): any;
  options(): Options;
  /** The files have changed: the model is read anew. */
  forget(): void;
}

/** Opens the module from its bytes, or from a compiled module. */
export function open(source: BufferSource | WebAssembly.Module): Promise<Lambent>;
