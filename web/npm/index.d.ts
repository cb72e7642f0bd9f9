// index.d.ts: the types of the package. web/npm.py generates DrawOptions from the program's table of options.
import type { DrawOptions } from './options.js';
export type { DrawOptions };

/** The kind of an error. It corresponds to the program's exit code. */
export type ErrorCode = 'BAD_ARGUMENT' | 'CANNOT_READ' | 'UNSUPPORTED' | 'LIMIT' | 'CANNOT_WRITE' | 'FAILED' | 'DISPOSED';

/** Thrown if a picture cannot be drawn. `message` is the program's error message. */
export class LambentError extends Error {
  constructor(sentence: string, code?: ErrorCode);
  readonly name: 'LambentError';
  readonly code: ErrorCode;
}

/** Files in memory, by their absolute path. Models use materials, textures and buffers from these files. */
export class Files {
  /** Stores or replaces a file. The bytes are not copied. A string is stored as UTF-8. */
  set(path: string, content: Uint8Array | ArrayBuffer | ArrayBufferView | string): void;
  get(path: string): Uint8Array | undefined;
  has(path: string): boolean;
  delete(path: string): boolean;
  /** Returns the paths of all files, sorted. */
  list(): string[];
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
  /** RGBA, four bytes for each pixel, rows from the top, as for ImageData. */
  pixels: ReturnType<typeof Uint8ClampedArray.from>;
  triangles: number;
  read_ms: number;
  frame_ms: number;
  camera: Camera;
  /** The bounding sphere of the scene. */
  sphere: { centre: [number, number, number]; radius: number };
  warnings: string[];
}

export type Format = 'png' | 'jpg' | 'ppm' | 'pfm';

export interface CallOptions {
  /**
   * Aborts the call. The call then throws the signal's reason. A LambentWorker can be aborted at any time. A Lambent blocks while it draws, so the signal
   * must be aborted before the call or in `onProgress`.
   */
  signal?: AbortSignal;
  /** Called at most 20 times a second, with the finished fraction from 0 to 1. Reading the model is the first half, and drawing it the second. */
  onProgress?: (share: number) => void;
}

export interface Described {
  version: string;
  shapes: string[];
  options: { name: string; group: string; value: string | null; default: string | null; summary: string; [more: string]: unknown }[];
}

/** The module for `open` and `openWorker`: its URL, Response, bytes or compiled module. The default is the file in the package. */
export type Source = string | URL | Response | BufferSource | WebAssembly.Module | undefined;

type Bytes = ReturnType<typeof Uint8Array.from>;

/** Draws pictures and blocks while it draws. `model` is a path in `files` or the name of a built-in shape. `words` are the words of a command line. */
export class Lambent {
  constructor(module: WebAssembly.Module, files?: Files, decoders?: WebAssembly.Module);
  readonly files: Files;
  draw(model: string, options?: DrawOptions, call?: CallOptions & { as?: 'pixels' }): Picture;
  draw(model: string, options: DrawOptions | undefined, call: CallOptions & { as: Format }): Bytes;
  draw(words: string[], call?: CallOptions & { as?: 'pixels' }): Picture;
  draw(words: string[], call: CallOptions & { as: Format }): Bytes;
  /** Returns the explanation of one pixel, as `lambent explain --json` prints it. `x` and `y` start at 0 in the upper left corner. */
  explain(model: string | string[], x: number, y: number, options?: DrawOptions): any;
  /** Returns the picture's lights in the form of a scene file, as `lambent lights` prints them. */
  lights(model: string | string[], options?: DrawOptions): any;
  /** Returns the options of `draw` as the program's help describes them, the names of the shapes, and the version. */
  describe(): Described;
  /** Frees the memory. Later calls throw a LambentError with the code DISPOSED. */
  dispose(): void;
}

/** Makes the same calls in a worker, one after another. */
export class LambentWorker {
  readonly files: Files;
  draw(model: string, options?: DrawOptions, call?: CallOptions & { as?: 'pixels' }): Promise<Picture>;
  draw(model: string, options: DrawOptions | undefined, call: CallOptions & { as: Format }): Promise<Bytes>;
  draw(words: string[], call?: CallOptions & { as?: 'pixels' }): Promise<Picture>;
  draw(words: string[], call: CallOptions & { as: Format }): Promise<Bytes>;
  explain(model: string | string[], x: number, y: number, options?: DrawOptions): Promise<any>;
  lights(model: string | string[], options?: DrawOptions): Promise<any>;
  describe(): Promise<Described>;
  /** Ends the worker, even while it draws. Waiting calls are rejected with the code DISPOSED. */
  dispose(): void;
}

export interface OpenOptions {
  /** Aborts the download. */
  signal?: AbortSignal;
  /** The module that decodes Draco and meshoptimizer: true for the file in the package, or its source. Without it, such files are refused. */
  decoders?: boolean | Source | Promise<Source>;
}

/** Loads the module. */
export function open(source?: Source | Promise<Source>, how?: OpenOptions): Promise<Lambent>;

/** Loads the module in a worker. `worker` is a function that creates the worker from `lambent/worker`, for bundlers that do not find its file by its URL. */
export function openWorker(source?: Source | Promise<Source>, how?: OpenOptions & { worker?: () => any }): Promise<LambentWorker>;
