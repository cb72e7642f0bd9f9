// sentence.js: converts an explanation to sentences for reading aloud.
import { plainName } from '../words/lights.js';
import { text } from '../base/strings.js';

const TERMS = [['ambient', 'termAmbient'], ['diffuse', 'termDiffuse'], ['specular', 'termSpecular'], ['reflection', 'termReflection'], ['emission', 'termEmission']];
const round = (x) => String(Number(x.toFixed(2)));
const share = (v) => (v[0] * 0.2126 + v[1] * 0.7152 + v[2] * 0.0722);

export function sentenceOf(pixel) {
  const triangle = pixel.triangles[0];
  const color = { red: pixel.bytes[0], green: pixel.bytes[1], blue: pixel.bytes[2] };
  if (!triangle) return text('spokenBackground', { x: pixel.x, y: pixel.y });
  const point = triangle.points[0], sum = share(point.sum);
  const parts = [text('spokenPixel', { x: pixel.x, y: pixel.y, object: triangle.object_name ?? text('unnamedObject', { number: triangle.object }), ...color })];
  for (const [name, key] of TERMS) {
    const part = share(point.terms[name]);
    if (sum > 0 && part / sum >= 0.005) parts.push(text('spokenTerm', { term: text(key), percent: Math.round((100 * part) / sum) }));
  }
  for (const light of point.lights) {
    const name = plainName(light.name ?? light.type);
    if (light.n_dot_l <= 0) parts.push(text('spokenBehind', { light: name }));
    else parts.push(text('spokenLight', { light: name, angle: Math.round(light.theta_deg), diffuse: round(light.D), specular: round(light.S) }));
  }
  return parts.join(' ');
}
