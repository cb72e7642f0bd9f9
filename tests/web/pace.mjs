// pace.mjs: tests the size of quick pictures (web/page/picture/pace.js), with simulated frames whose time is proportional to their pixels. Prints lines of
// the Test Anything Protocol without numbers.
import { Pace } from '../../web/page/picture/pace.js';

const ok = (good, label, why = '') => console.log(`${good ? 'ok' : 'not ok'} ${label}${good ? '' : `\n# ${why}`}`);

// The scales of frames of a picture that takes `ms` at full size.
function scales(pixels, ms, pace = new Pace()) {
  return Array.from({ length: 60 }, () => {
    const scale = pace.scale(pixels);
    pace.measured(ms * scale * scale);
    return scale;
  });
}

const last = (list) => list.at(-1), changes = (list) => list.slice(1).filter((scale, i) => scale !== list[i]).length;
const LARGE = 928 * 656, SMALL = 400 * 300;
ok(scales(LARGE, 10)[0] === 0.5 && last(scales(LARGE, 10)) === 1, 'a large picture begins with half, and has all pixels if there is time', scales(LARGE, 10));
ok(scales(SMALL, 10)[0] === 1 && changes(scales(SMALL, 10)) === 0, 'a small one begins with all', scales(SMALL, 10));
ok(last(scales(SMALL, 100)) < 0.6 && Math.min(...scales(SMALL, 10_000)) === 0.5, 'and has fewer where it is slow, but at least half', scales(SMALL, 100));
for (const ms of [30, 45, 60, 90]) {
  const found = scales(LARGE, ms);
  ok(ms * last(found) ** 2 <= 28 && changes(found.slice(20)) === 0, `a whole picture of ${ms} ms: below a thirtieth of a second, and the size stays`, found);
}
const pace = new Pace();
scales(LARGE, 200, pace);
pace.reset();
ok(pace.scale(SMALL) === 1, 'another model begins anew');
