// npm_sample.ts: a program with the package's types (tests/npm.py): it compiles, and the lines with @ts-expect-error do not.
import { type DrawOptions, Files, Lambent, LambentError, type Picture, open, openWorker } from 'lambent';

const options: DrawOptions = { size: '800x600', view: 'front', shadows: true, light: ['ambient', 'point:position=1/2/3'], samples: 8, background: 'white' };
// @ts-expect-error: a misspelt option
const misspelt: DrawOptions = { sice: 512 };
// @ts-expect-error: an option without a value
const wrong: DrawOptions = { shadows: 'yes' };

export async function draw(bytes: ArrayBuffer, canvas: CanvasRenderingContext2D): Promise<Uint8Array> {
  const lambent: Lambent = await open(fetch('lambent.wasm'), { signal: AbortSignal.timeout(1000) });
  lambent.files.set('/a.stl', bytes);
  lambent.files.set('/a.mtl', 'newmtl a');
  const picture: Picture = lambent.draw('/a.stl', options, { onProgress: (share: number) => console.log(share) });
  canvas.putImageData(new ImageData(picture.pixels, picture.width, picture.height), 0, 0);
  const png: Uint8Array = lambent.draw('/a.stl', { size: 64 }, { as: 'png' });
  const same: Uint8Array = lambent.draw(['/a.stl', '--size', '64'], { as: 'jpg' });
  // @ts-expect-error: not a format
  lambent.draw('/a.stl', {}, { as: 'gif' });
  // @ts-expect-error: a number is no file
  lambent.files.set('/a.stl', 42);
  lambent.dispose();
  return png.length > same.length ? png : same;
}

export async function drawLater(files: Files): Promise<void> {
  const lambent = await openWorker(undefined, { worker: () => new Worker('worker.js', { type: 'module' }) });
  try {
    const picture: Picture = await lambent.draw('teapot', { size: 64 }, { signal: new AbortController().signal });
    const bytes: Uint8Array = await lambent.draw(['teapot'], { as: 'png' });
    console.log(picture.camera.eye[0], bytes.length, files.list(), misspelt, wrong);
  } catch (error) {
    if (error instanceof LambentError && error.code === 'CANNOT_READ') console.log(error.message);
  } finally {
    lambent.dispose();
  }
}
