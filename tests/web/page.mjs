// page.mjs ONE_FILE: tests the page's state, its camera and the single-file page without a browser; prints lines of the Test Anything
// Protocol without numbers.
import { createHash } from 'node:crypto';
import { readFileSync, readdirSync } from 'node:fs';
import { around, cameraText, onBall, orbit, pan, project, readCamera, shifted, zoom } from '../../web/page/words/camera.js';
import { dirname, join } from 'node:path';
import { open } from '../../web/lambent.js';
import { aroundEquations, lightEquations, pixelEquations, sumEquation } from '../../web/page/explain/equations.js';
import { lightText, lightWords, movedTo, newLight, parseLight, placeOf, withCone } from '../../web/page/words/lights.js';
import { companions, ranked, setsSize, withNeighbours } from '../../web/page/files/ranked_models.js';
import '../../web/page/shaders/shader_strings.js';
import { pseudo, stringKeys, text } from '../../web/page/base/strings.js';
import { FORMULAS, State, command, fromFragment, quoted, toFragment, withModel } from '../../web/page/words/state.js';

const ok = (good, label) => console.log(`${good ? 'ok' : 'not ok'} ${label}`);
const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);
const near = (a, b) => a.every((x, i) => Math.abs(x - b[i]) < 1e-9);

// The state is a list of words; one gesture is one step of undo.
const state = new State(['teapot', '--size=64']);
state.set(state.withValues('light', ['position=1/2/3', 'position=3/2/1']));
state.set(state.withValues('size', ['128']));
ok(same(state.words, ['teapot', '--size=128', '--light=position=1/2/3', '--light=position=3/2/1']), 'options stay in their places');
ok(same(state.values('light'), ['position=1/2/3', 'position=3/2/1']) && same(state.values('lights'), []), 'values of an option that repeats');
for (const angle of ['1', '2', '3']) state.set(state.withValues('azimuth', [angle]), 'gesture');
state.undo();
ok(!state.values('azimuth').length, 'a gesture is undone at once');
state.redo();
ok(same(state.values('azimuth'), ['3']) && !state.canRedo, 'and redone');
state.set(state.withValues('two-sided', ['']));
ok(state.words.at(-1) === '--two-sided' && same(state.withValues('two-sided', []).includes('--two-sided'), false), 'a switch has no value');

// Links and commands preserve every word.
const odd = ["/my models/it's.obj", '--color=#ff8800', '--light=position=1/2/3,name=a&b%', '--material=Bühne'];
ok(same(fromFragment(toFragment(odd)), odd), 'a link holds the words');
ok(fromFragment('#%') === null && fromFragment('') === null, 'a damaged link is none');
ok(command(odd) === "lambent 'my models/it'\\''s.obj' '--color=#ff8800' '--light=position=1/2/3,name=a&b%' '--material=Bühne'", 'a command is quoted');
ok(command(['/teapot']) === 'lambent ./teapot' && command(['/-x.obj']) === 'lambent ./-x.obj' && command(['teapot']) === 'lambent teapot', 'files are no shapes or options');
// A formula is a model: `lambent shape` draws it, and its options disappear when another model is
// chosen.
const ball_words = withModel(['teapot', '--size=64'], 'implicit');
ok(same(ball_words, ['implicit', '--implicit=x^2+y^2+z^2-1', '--size=64']) && command(ball_words) === "lambent shape '--implicit=x^2+y^2+z^2-1' --size=64", 'an implicit surface is a model');
ok(same(withModel([...ball_words, '--z=0..1', '--flip', '--zoom=2'], 'cube'), ['cube', '--size=64', '--zoom=2']), "a formula's options go with it");
ok(quoted('a;b') === "'a;b'" && quoted('x/y.obj') === 'x/y.obj', 'quotes where a shell needs them');

// The camera.
const camera = { eye: [0, 0, 5], target: [0, 0, 0], up: [0, 1, 0], fovy_deg: 30, ortho: 0 };
ok(near(orbit(camera, Math.PI / 2, 0, [0, 1, 0], [0, 0, 0]).eye, [5, 0, 0]), 'a quarter of a turn to the right');
ok(near(orbit(orbit(camera, 0.3, 0.2, [0, 1, 0], [0, 0, 0]), -0.3, -0.2, [0, 1, 0], [0, 0, 0]).eye, [0, 0, 5]), 'there and back');
const high = orbit(camera, 0, 3, [0, 1, 0], [0, 0, 0]).eye;
ok(high[1] > 4.99 && high[2] > 0, 'it stays below the pole');
ok(near(pan(camera, 0.5, 0).target, [-5 * Math.tan(Math.PI / 12), 0, 0]), 'half a picture to the side');
ok(near(pan(camera, 0, 0.5).target, [0, -5 * Math.tan(Math.PI / 12), 0]), 'half a picture up');
ok(near(zoom(camera, 2).eye, [0, 0, 2.5]) && zoom({ ...camera, ortho: 3 }, 2).ortho === 1.5, 'zoom');
ok(Math.abs(around(camera, { centre: [1, 2, 3], radius: 2 }, 1).eye[2] - 3 - 2 / Math.sin(Math.PI / 12)) < 1e-9, 'a ball fills the picture');
ok(cameraText(orbit(camera, 1, 0.5, [0, 1, 0], [0, 0, 0])) === 'eye=3.6923/2.39713/2.3708,target=0/0/0,up=0/1/0,fovy=30', 'decimal text');

const unitBall = { centre: [0, 0, 0], radius: 1 };
// Handles of lights: each move of a handle by a fraction of the picture's height, and the resulting words. The picture is 10 tan 15° = 2.679 high
// at the model's middle.
const ball = { centre: [0, 0, 0], radius: 2 };
const MOVES = [
  ['point:position=0/0/0', 'position', [0.5, 0, 0], 'point:position=1.3397/0/0'],
  ['+point:color=red,position=0r/0r/0r', 'position', [0, 0.5, 0], '+point:color=red,position=0r/0.6699r/0r'],
  ['point:position=0/0/0,frame=view', 'position', [0, 0.5, 0], 'point:position=0/1.3397/0,frame=view'],
  ['point:frame=camera,position=0/0/-5', 'position', [0.5, 0, 0], 'point:frame=camera,position=1.3397/0/-5'],
  ['point:position=0/0/0', 'position', [0, 0, 1], 'point:position=0/0/-2.6795'],
  ['directional:direction=0/0/-1,intensity=2', 'position', [0, 10, 0], 'directional:direction=0/-0.9855/-0.1697,intensity=2'],
  ['spot:position=0/2/0', 'aim', [0.5, 0, 0], 'spot:position=0/2/0,target=0.6699r/0r/0r'],
  ['spot:position=0/2/0,direction=0/-1/0', 'aim', [0.5, 0, 0], 'spot:position=0/2/0,direction=0.5565/-0.8308/0'],
];
for (const [words, part, by, wanted] of MOVES) {
  const light = parseLight(words), place = placeOf(light, camera, ball);
  const found = lightText(movedTo(light, part, shifted(camera, place[part], ...by), camera, ball));
  ok(found === wanted, `handle: ${words}, ${part} by ${by.join(' ')}${found === wanted ? '' : `: found ${found}, expected ${wanted}`}`);
}
ok(lightText(withCone(parseLight('spot:inner=10,outer=20'), 40)) === 'spot:inner=20,outer=40' && lightText(withCone(parseLight('spot'), 200)) === 'spot:cutoff=90', 'the cone keeps its softness and its limits');
ok(placeOf(parseLight('hemisphere'), camera, ball) === null && placeOf(parseLight('point:frame=object:lid'), camera, ball) === null, 'lights without a place have no handle');
ok(newLight('point', [], 0).startsWith('+point:') && newLight('spot', ['point'], 1).startsWith('spot:'), 'a new light stands beside the others');
const seen = project(camera, [5 * Math.tan(Math.PI / 12), 0, 0], 2);
ok(near([seen.x, seen.y], [0.75, 0.5]) && project(camera, [0, 0, 9], 1).behind, 'a point where the picture shows it');

// A point on a ball, by its position in the picture: on both sides, beside the ball, and with a parallel projection.
for (const [view, x, isFar] of [[camera, 0.55, false], [camera, 0.55, true], [camera, 0.95, false], [{ ...camera, ortho: 1.5 }, 0.6, false]]) {
  const point = onBall(view, unitBall, x, 0.45, 1, isFar), at = project(view, point, 1), isBeside = x > 0.9;
  ok(Math.abs(Math.hypot(...point) - 1) < 1e-9 && (isBeside || (near([at.x, at.y], [x, 0.45]) && point[2] > 0 !== isFar)), `a point on a ball at ${x}${isFar ? ', on the far side' : ''}`);
}

// Opened files: the model that is shown first, and the files that belong to a model.
const bytesOf = (text) => new TextEncoder().encode(text), tree = (files) => new Map(Object.entries(files).map(([path, text]) => [path, bytesOf(text)]));
const folder = tree({ '/s/a_control.obj': 'v 0 0 0\n', '/s/b_plain.obj': 'v 0 0 0\n'.repeat(9), '/s/c_away.obj': `mtllib none.mtl\n${'v 0 0 0\n'.repeat(50)}`, '/s/s.mtl': 'newmtl a\nmap_Kd -s 1 1 1 s.png\n', '/s/s.png': '',
  '/s/textured.obj': 'mtllib s.mtl\nv 0 0 0\n', '/s/package.json': '{}' });
const order = ranked([...folder.keys()].filter((path) => /obj|json/.test(path)), folder);
ok(same(order, ['/s/textured.obj', '/s/b_plain.obj', '/s/a_control.obj', '/s/c_away.obj', '/s/package.json']), `the textured model comes first, and then the largest: ${order.join(' ')}`);
const given = tree({ '/f/b/T.png': '1', '/f/a/t.png': '2', '/f/a/u/v.png': '3' }), found = companions(['/x/a/t.png', '/x/none.png'], given);
ok(same([...found], [['/x/a/t.png', '/f/a/t.png']]), 'a missing file is found by its name and its folders');
ok(same([...withNeighbours(found, given).keys()], ['/x/a/t.png', '/x/a/u/v.png']), 'with the files beside it');
ok(setsSize('/a.json', tree({ '/a.json': '{"image":{"size":[2,2]}}' })) && !setsSize('/a.json', tree({ '/a.json': '{' })) && !setsSize('/a.obj', folder), 'a scene file with a size');

// Equations: the computed right side equals the program's number. For three numbers, they are red, green
// and blue.
const lambent = await open(readFileSync(join(dirname(process.argv[2]), 'wasm', 'web', 'lambent.wasm')));
function computed(values, channel) {
  const one = values.replace(/\((-?[\d.e+-]+), (-?[\d.e+-]+), (-?[\d.e+-]+)\)/g, (...parts) => `(${parts[1 + channel]})`);
  const script = one.replaceAll('·', '*').replaceAll('−', '-').replaceAll('^', '**').replace(/\b(min|max|floor)\(/g, 'Math.$1(');
  if (!/^[-\d.e+*/() ,Mathminxflor]*$/.test(script)) throw new Error(values);
  return Function(`return ${script}`)();
}
const EQUATIONS = [['torus', '--reflection=kajiya-kay'], ['torus', '--reflection=kajiya-kay-lecture', '--light=directional:direction=1/1/-1'],
  ['teapot', '--tone=reinhard', '--exposure=-1', '--background=white', '--material=opacity=0.5'], ['teapot'], ['teapot', '--reflection=phong', '--material=brass'], ['sphere', '--light=spot:position=0/0/4,cutoff=40,exponent=3,attenuation=0.5/0.1/0.05,range=6', '--ambient=0.2'],
  ['torus-knot', '--material=metallic=0.4,roughness=0.5,color=#c9a227', '--light=directional:direction=-1/-1/-1'], ['teapot', '--reflection=oren-nayar'], ['teapot', '--shadows', '--shading=gouraud'],
  ['sphere', '--reflection=lambert', '--rig=lecture'], ['sphere', '--light=spot:position=0/0/4,inner=1,outer=30'], ['sphere', '--light=spot:position=0/0/4,cutoff=1'], ['sphere', '--light=point:position=0/0/-4'], ['teapot', '--environment=studio', '--reflectivity=0.4', '--ao=screen'], ['cube', '--material=ambient=0.2/0.4/0.8,diffuse=red', '--ambient=0.5/0.4/0.3', '--ao=off'], ['sphere', '--material=metallic=0.3,roughness=0.5,color=#c9a227', '--ambient=0.4']];
let checked = 0;
for (const words of EQUATIONS) {
  const pixel = lambent.explain([...words, '--size=96'], 46, 44), triangle = pixel.triangles[0], wrong = [];
  for (const point of triangle.points)
    for (const { name, values, result } of [sumEquation(point), ...aroundEquations(triangle, point), ...point.lights.flatMap((light) => lightEquations(triangle, point, light))]) {
      if (!values) continue;
      checked++;
      for (const channel of [0, 1, 2]) {
        const wanted = Array.isArray(result) ? result[channel] : result, found = computed(values, channel);
        // Four digits to a power of up to 128.
        if (!(Math.abs(found - wanted) <= 0.03 * Math.abs(wanted) + 1e-9)) wrong.push(`${name}: ${values} is ${found}, the program has ${wanted}`);
      }
    }
  // from the sum to the bytes, with the numbers of the text alone
  for (const { name, values, result } of pixelEquations(pixel)) {
    if (!values) continue;
    checked++;
    for (const channel of [0, 1, 2]) {
      const found = computed(values, channel);
      if (!(name === 'bytes' ? found === result[channel] : Math.abs(found - result[channel]) < 1e-5)) wrong.push(`${name}: ${values} is ${found}, the program has ${result}`);
    }
  }
  ok(!wrong.length, `equations: ${words.join(' ')}${wrong.map((one) => `: ${one}`).join('')}`);
}
ok(checked > 50, `equations: ${checked} were computed`);

// The memory limit: the error message contains its numbers, and the command line's own limit has priority.
const refusal = (words) => {
  try {
    return lambent.draw(words) && '';
  } catch (error) {
    return error.message;
  }
};
lambent.limitMemory(1.5e6);
ok(refusal(['sphere', '--size=1024']) === 'the picture of 1024x1024 pixels needs 4.2 MB, more than the memory limit of 1.5 MB (--memory-limit)', `memory: ${refusal(['sphere', '--size=1024'])}`);
ok(refusal(['sphere', '--size=1024', '--memory-limit=none']) === '', 'memory: --memory-limit none');
lambent.limitMemory(0);
ok(refusal(['sphere', '--size=1024']) === '', 'memory: without a limit');

// Formulas, drawn by the module.
for (const [name, formula] of Object.entries(FORMULAS)) ok(lambent.draw([name, `--${name}=${formula}`, '--size=64']).triangles > 1000, `the model ${name}`);
ok(refusal(['cube', '--implicit=x', '--size=64']) === "option '--implicit' belongs to the model 'implicit'" && /column 3/.test(refusal(['implicit', '--implicit=x+w', '--size=64'])), 'a formula that is wrong');

// The lights of a picture, converted to options, draw the same picture.
for (const words of [['teapot'], ['torus-knot', '--rig=three-point', '--shadows'], ['cube', '--rig=headlight']]) {
  const all = [...words, '--size=64'], { lights, image } = lambent.lights(all), own = [...all.filter((word) => !word.startsWith('--rig')), ...lights.map((light) => `--light=${lightWords(light)}`), `--tone=${image?.tone ?? 'auto'}`];
  ok(lights.length > 0 && Buffer.compare(lambent.save(all, 'png'), lambent.save(own, 'png')) === 0, `the lights as words: ${words.join(' ')}`);
}

// The strings: every key that a script or the page uses is in the table, and each key of the table is used; a pseudo-locale preserves
// {names}.
const scriptsFolder = new URL('../../web/page/', import.meta.url);
const paths = ['', ...readdirSync(scriptsFolder, { withFileTypes: true }).filter((entry) => entry.isDirectory()).map((entry) => entry.name + '/')]
  .flatMap((inner) => readdirSync(new URL(inner, scriptsFolder)).map((name) => inner + name)).filter((path) => /\.(js|html)$/.test(path));
const sources = paths.map((path) => [path.split('/').at(-1), readFileSync(new URL(path, scriptsFolder), 'utf8')]);
const html = Object.fromEntries(sources)['index.html'], scripts = sources.filter(([name]) => name !== 'strings.js').map(([, source]) => source).join('\n');
const named = [...html.matchAll(/data-(?:text|label|title|placeholder)="(\w+)"/g), ...scripts.matchAll(/\b(?:text\(|button\(|key: )'(\w+)'/g)].map((match) => match[1]);
const unknown = named.filter((key) => !stringKeys().includes(key)), unused = stringKeys().filter((key) => !new RegExp(`['"]${key}['"]`).test(scripts + html));
ok(named.length > 30 && !unknown.length && !unused.length, `strings: the table has all, and no more${[...unknown, ...unused].map((key) => ' ' + key).join('')}`);
ok(pseudo('saved {file}') === '⟦šávéd {file}~~~~⟧' && text('removeNamed', { light: 'a' }) === 'Remove a', 'strings: values and the pseudo-locale');
const bare = html.replace(/<(title|h1 translate="no")>[^<]*/g, '').replace(/<[^>]*>/g, '').trim();
ok(bare === '', `strings: the page itself has none${bare && ': ' + bare}`);

// The single-file page: its policy allows only its own script and style, and nothing is downloaded.
const page = readFileSync(process.argv[2], 'utf8');
const hash = (text) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;
const script = /<script type="module">([^]*?)<\/script>/.exec(page)[1], style = /<style>([^]*?)<\/style>/.exec(page)[1];
const policy = /Content-Security-Policy" content="([^"]*)"/.exec(page)[1];
ok(policy.startsWith("default-src 'none'; ") && policy.includes(hash(script)) && policy.includes(hash(style)), 'the policy names the script and the style');
// served.js contains some, for the viewer's page, and start.js contains one that this page does not call, because its
// policy refuses them.
const fetches = (...names) => names.reduce((sum, name) => sum + Object.fromEntries(sources)[name].split('fetch(').length - 1, 0);
ok(!/^(import|export) /m.test(script) && script.split('fetch(').length - 1 === fetches('served.js', 'start.js') && !policy.includes('connect-src') && !/(src|href)="(?!data:)/.test(page), 'one file needs no other');
