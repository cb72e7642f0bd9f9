// equations.js: makes the equations of an explained point, with their values. The formulas of D and of the highlight's base come from the program;
// tests/web/page.mjs computes each right-hand side and compares it with the program's number.

// Returns a number as text with six digits, so that the bytes can be computed from the text. Only very large and very small numbers have an exponent.
export function number(x) {
  if (x === null || x === undefined) return '';
  const rounded = Number(x.toPrecision(6)), size = Math.abs(rounded);
  return rounded === 0 ? '0' : size >= 1e-4 && size < 1e6 ? String(rounded) : rounded.toExponential();
}

export const triple = (v) => (v[0] === v[1] && v[1] === v[2] ? number(v[0]) : `(${v.slice(0, 3).map(number).join(', ')})`);

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

// Replaces the dot products in a formula by their values. Returns null if the formula contains other names.
function filled(formula, point, light) {
  const { t } = point, of = (v) => (t ? dot(t, v) : 0), sine = (v) => Math.sqrt(Math.max(0, 1 - of(v) ** 2));
  const values = { 'n·l': light.n_dot_l, 'n·h': dot(point.n, light.h), 'r·v': dot(light.r, point.v), 'cos(t,l)': of(light.l), 'cos(t,v)': of(point.v), 'sin(t,l)': sine(light.l), 'sin(t,v)': sine(point.v) };
  const text = formula.replace(/[nr]·[lhv]|(sin|cos)\(t,[lv]\)/g, (name) => number(values[name])).replace(/(\d) (-?\d)/g, '$1 · $2');
  return /^(max\([-−\d.e+· ]+, 0\)|[\d.e-]+)$/.test(text) ? text : null;
}

// Returns the formula of a spot light's cone, and the formula with numbers in place of its names.
function coneEquation({ cone, cos_axis: c, spot }) {
  const cosine = (degrees) => Math.cos((degrees * Math.PI) / 180);
  if (cone.outer_deg) {
    const inner = number(cosine(cone.inner_deg)), outer = number(cosine(cone.outer_deg));
    return [`clamp((c − cos outer) / max(0.001, cos inner − cos outer), 0, 1)²`, `max(min((${number(c)} − ${outer}) / max(0.001, ${inner} − ${outer}), 1), 0)^2`];
  }
  if (spot === 0 && cone.cutoff_deg && c < cosine(cone.cutoff_deg)) return [`0: outside of the cone, c = ${number(c)} < cos cutoff = ${number(cosine(cone.cutoff_deg))}`, null];
  return ['max(c, 0)^ε', `max(${number(c)}, 0)^${number(cone.exponent)}`];
}

// Returns a light's rows: { name, formula, values, result }. `values` is null if the program reports only the result.
export function lightEquations(triangle, point, light) {
  const { formulas } = triangle, rows = [];
  const add = (name, formula, values, result) => rows.push({ name, formula, values, result });
  if (light.distance !== null) {
    const [a, b, c] = light.attenuation_terms.map(number), d = number(light.distance);
    const window = light.range ? [' · max(min(1 − (d/range)⁴, 1), 0)', ` · max(min(1 − (${d}/${number(light.range)})^4, 1), 0)`] : ['', ''];
    add('attenuation', `1 / (a + b d + c d²)${window[0]}`, `1 / (${a} + ${b} · ${d} + ${c} · ${d}^2)${window[1]}`, light.attenuation);
  }
  if (light.type === 'spot') add('spot', ...coneEquation(light), light.spot);
  if (light.occlusion !== 1) add('occlusion', '1 − occluded (1 − unoccluded)', null, light.occlusion);
  if (light.casts_shadows) add('passed', '', null, light.passed);
  const gate = formulas.gated ? '[n·l > 0] ' : '', open = !formulas.gated || light.n_dot_l > 0;
  for (const [name, v] of formulas.threads && point.t ? [['cos(t,l)', light.l], ['cos(t,v)', point.v]] : []) add(name, `t·${name[6]}`, null, dot(point.t, v));
  add('D', `${formulas.threads ? gate : ''}${formulas.D}`, open || !formulas.threads ? filled(formulas.D, point, light) : '0', light.D);
  const { layers } = light, all = point.layers;
  if (layers) { // the fraction of light that each layer of the surface reflects
    add('S', 'of the base', null, layers.S);
    add('base', 'F S', null, layers.base);
    if (all.sheen_left < 1) add('left', '1 − max(sheen_color) E', null, layers.sheen_left), add('sheen', '', null, layers.sheen);
    if (all.coat > 0) add('share', 'clearcoat (0.04 + 0.96 (1 − |n_c·v|)⁵)', null, all.coat), add('coat', 'share · S of the coat', null, layers.coat);
  } else if (formulas.microfacet) add('S', `${gate}π D(h) V max(n·l, 0)`, open ? `3.14159265 · ${number(light.distribution)} · ${number(light.visibility)} · max(${number(light.n_dot_l)}, 0)` : '0', light.S);
  else if (formulas.base) {
    const base = filled(formulas.base, point, light) ?? number(light.base);
    add('S', `${gate}${formulas.base}^α`, open ? `${base}^${number(light.power)}` : '0', light.S);
  }
  const before = [['spot', light.type === 'spot', light.spot], ['attenuation', light.distance !== null, light.attenuation], ['occlusion', light.occlusion !== 1, light.occlusion]];
  const product = (color, colorValue, answer, answerValue, passed) => {
    const factors = [...before.filter(([, there]) => there).map(([name, , value]) => [name, number(value)]), [color, triple(colorValue)], [answer, number(answerValue)]];
    if (passed) factors.push(['passed', triple(light.passed)]);
    return [factors.map(([name]) => name).join(' · '), factors.map(([, value]) => value).join(' · ')];
  };
  if (light.left_out) return rows;
  add('diffuse', ...product(formulas.microfacet ? 'base (1 − metallic) Ld' : 'kd Ld', light.kd_Ld, 'D', light.D, light.casts_shadows), light.diffuse_term);
  if (layers) {
    const under = all.sheen_left < 1 ? 'left base + sheen' : 'base';
    add('specular', all.coat > 0 ? `Ls ((1 − share) (${under}) + coat)` : `Ls (${under})`, null, light.specular_term);
  }
  else if (formulas.base || formulas.microfacet) add('specular', ...product(formulas.microfacet ? 'F Ls' : 'ks Ls', light.ks_Ls, 'S', light.S, light.casts_shadows), light.specular_term);
  return rows;
}

// Returns the rows of light from all directions: hemisphere lights, ambient light, the environment.
export function aroundEquations(triangle, point) {
  const rows = [], add = (name, formula, values, result) => rows.push({ name, formula, values, result });
  if (triangle.model === 'none') return rows;
  const [ka, kd] = triangle.material.matrix.map((row) => row.map((x, i) => x * point.color[i])), terms = point.hemispheres.map(({ term }) => triple(term)), dimmed = point.unoccluded !== 1;
  for (const { name, ground, sky, n_dot_up, by_diffuse, term } of point.hemispheres)
    add(name ?? 'hemisphere', `${by_diffuse ? 'kd' : 'ka'} (ground + (sky − ground) (½ + ½ n·up))`, `${triple(by_diffuse ? kd : ka)} · (${triple(ground)} + (${triple(sky)} − ${triple(ground)}) · (0.5 + 0.5 · ${number(n_dot_up)}))`, term);
  const sum = [`${triple(ka)} · ${triple(point.ambient_light)}`, ...terms].join(' + ');
  if (point.terms.ambient.some((x) => x !== 0))
    add('ambient', `${dimmed ? 'unoccluded · (' : ''}ka La${terms.length ? ' + Σ hemispheres' : ''}${dimmed ? ')' : ''}`, dimmed ? `${number(point.unoccluded)} · (${sum})` : sum, point.terms.ambient);
  const { environment: e } = point, { reflectivity } = triangle.material;
  if (!e) return rows;
  if (e.prefiltered) {
    for (const name of ['irradiance', 'prefiltered', 'scale', 'bias']) add(name, '', null, e[name]);
    const { layers } = point;
    if (layers) {
      add('diffuse part', '', null, e.diffuse_part);
      for (const name of ['mirrored', 'sheen', 'coat']) if (layers[`${name}_part`].some((x) => x !== 0)) add(`${name} part`, '', null, layers[`${name}_part`]);
    } else {
      add('diffuse part', 'kd irradiance (1 − (0.04 scale + bias))', null, e.diffuse_part);
      add('mirrored part', 'prefiltered (f0 scale + bias)', null, e.specular_part);
    }
  } else if (point.terms.reflection.some((x) => x !== 0)) add('reflection', `${dimmed ? 'unoccluded · ' : ''}kr environment`, `${dimmed ? `${number(point.unoccluded)} · ` : ''}${triple(reflectivity)} · ${triple(e.light)}`, point.terms.reflection);
  return rows;
}

// Returns the sum of a point's terms.
export function sumEquation(point) {
  const names = ['emission', 'ambient', 'diffuse', 'specular', 'reflection'].filter((name) => point.terms[name].some((x) => x !== 0));
  return { name: 'sum', formula: names.join(' + ') || '0', values: names.map((name) => triple(point.terms[name])).join(' + ') || '0', result: point.sum };
}

// Returns the rows from the sum of a point to the bytes of the pixel.
export function pixelEquations(pixel) {
  const rows = [], add = (name, formula, values, result) => rows.push({ name, formula, values, result });
  const { triangles, sum, exposure, exposed, curved, toned, encoded, background, formulas, behind } = pixel;
  const filledBy = (formula, color) => formula.replaceAll('²', '^2').replace(/\bx\b/g, triple(color)), alpha = sum[3], rest = background[3] * (1 - alpha);
  const parts = triangles.map(({ weight, color }) => `${number(weight * color[3])} · ${triple(color)}`);
  if (behind) parts.push(triple(behind));
  add('weighted sum', 'Σ weight · alpha · colour', parts.join(' + '), sum.slice(0, 3));
  if (exposure !== 1 || alpha !== 1) add('colour', 'exposure · sum ÷ alpha', alpha ? `${number(exposure)} · ${triple(sum)} / ${number(alpha)}` : '0', exposed);
  if (pixel.tone !== 'none') add('toned', `${pixel.tone}: ${formulas.curved}`, /^[-\d.·/ min(),x+²]*$/.test(formulas.curved) ? filledBy(formulas.curved, exposed) : null, curved);
  if (rest > 0) add('over the background', '(alpha · colour + (1 − alpha) · background) ÷ alpha', `(${number(alpha)} · ${triple(curved)} + ${number(rest)} · ${triple(background)}) / ${number(alpha + rest)}`, toned);
  const [low, high] = formulas.encoded.split(/ [?:] /).slice(1), dark = toned.map((x) => x <= 0.0031308);
  const one = !high ? formulas.encoded : dark.every((x) => x) ? low : dark.some((x) => x) ? null : high;
  add('encoded', `${pixel.encoding}: ${formulas.encoded}`, one && filledBy(one, toned), encoded);
  add('bytes', formulas.bytes, filledBy(formulas.bytes.replace('½', '0.5'), encoded), pixel.bytes.slice(0, 3));
  return rows;
}

// Converts a point of an explanation from eye space to world space.
export const worldOf = ({ side, above, back }, eye, v) => eye.map((x, i) => x + side[i] * v[0] + above[i] * v[1] + back[i] * v[2]);
