// index.d.ts: the types of the package. DrawOptions is made from the program's table of options.
import type { DrawOptions } from './options.js';
export type { DrawOptions };

/** The kind of an error, by the program's exit codes. */
export type ErrorCode = 'BAD_ARGUMENT' | 'CANNOT_READ' | 'UNSUPPORTED' | 'LIMIT' | 'CANNOT_WRITE' | 'FAILED' | 'DISPOSED';

/** A picture that cannot be drawn. `message` is the program's sentence: file, position, found, expected. */
export class LambentError extends Error {
  constructor(sentence: string, code?: ErrorCode);
  readonly name: 'LambentError';
  readonly code: ErrorCode;
}

/** Files in memory, by their absolute path. A model reads the files that it names from there. */
export class Files {
  /** Stores or replaces a file. The bytes are not copied; a text is stored as UTF-8. */
  set(path: string, content: Uint8Array | ArrayBuffer | ArrayBufferView | string): void;
  get(path: string): Uint8Array | undefined;
  has(path: string): boolean;
  delete(path: string): boolean;
  /** The paths, sorted. */
  list(): string[];
}

export interface Camera {
  eye: [number, number, number];
  target: [number, number, number];
  up: [number, number, number];
  /** Full vertical field of view in degrees; counts if `ortho` is 0. */
  fovy_deg: number;
  /** Half the height of an orthographic view in model units; 0: perspective. */
  ortho: number;
  /** The scene's up axis. */
  pole: [number, number, number];
}

export interface Picture {
  width: number;
  height: number;
  /** RGBA, four bytes for each pixel, rows from the top, as ImageData takes them. */
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
   * Aborts the call, which throws the signal's reason. In a worker at any moment; else before the call, and from `onProgress`, since nothing
   * else runs meanwhile.
   */
  signal?: AbortSignal;
  /** Gets the share that is done, 0 to 1: the first half is reading, the second drawing. At most 20 times a second. */
  onProgress?: (share: number) => void;
}

export interface Described {
  version: string;
  shapes: string[];
  options: { name: string; group: string; value: string | null; default: string | null; summary: string; details: string | null; [more: string]: unknown }[];
}

/** The argument of `open` and `openWorker`: the module's URL, Response, bytes or compiled module. By default it is the package's own file. */
export type Source = string | URL | Response | BufferSource | WebAssembly.Module | undefined;

type Bytes = ReturnType<typeof Uint8Array.from>;

/** Draws while it is called. `model`: a path of `files` or the name of a shape, with options by name; or the words of a command line. */
export class Lambent {
  constructor(module: WebAssembly.Module, files?: Files);
  readonly files: Files;
  draw(model: string, options?: DrawOptions, call?: CallOptions & { as?: 'pixels' }): Picture;
  draw(model: string, options: DrawOptions | undefined, call: CallOptions & { as: Format }): Bytes;
  draw(words: string[], call?: CallOptions & { as?: 'pixels' }): Picture;
  draw(words: string[], call: CallOptions & { as: Format }): Bytes;
  /** One pixel, counted from the upper left corner, in the form of `lambent explain --json`. */
  explain(model: string | string[], x: number, y: number, options?: DrawOptions): any;
  /** The picture's lights in the form of a scene file, as `lambent lights` prints them. */
  lights(model: string | string[], options?: DrawOptions): any;
  /** The options of `draw` as the program's help describes them. */
  describe(): Described;
  /** Frees the memory. Later calls throw a LambentError with the code DISPOSED. */
  dispose(): void;
}

/** The same in a worker: calls are answered one after the other. */
export class LambentWorker {
  readonly files: Files;
  draw(model: string, options?: DrawOptions, call?: CallOptions & { as?: 'pixels' }): Promise<Picture>;
  draw(model: string, options: DrawOptions | undefined, call: CallOptions & { as: Format }): Promise<Bytes>;
  draw(words: string[], call?: CallOptions & { as?: 'pixels' }): Promise<Picture>;
  draw(words: string[], call: CallOptions & { as: Format }): Promise<Bytes>;
  explain(model: string | string[], x: number, y: number, options?: DrawOptions): Promise<any>;
  lights(model: string | string[], options?: DrawOptions): Promise<any>;
  describe(): Promise<Described>;
  /** Ends the worker, also while it draws: calls that wait are rejected with the code DISPOSED. */
  dispose(): void;
}

/** `signal` aborts the fetch of the module. */
export function open(source?: Source | Promise<Source>, how?: { signal?: AbortSignal }): Promise<Lambent>;

/** `worker` makes the worker (of `lambent/worker`), for bundlers that do not find it by its URL. */
export function openWorker(source?: Source | Promise<Source>, how?: { signal?: AbortSignal; worker?: () => any }): Promise<LambentWorker>;
