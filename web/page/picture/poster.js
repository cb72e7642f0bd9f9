// poster.js: until the first picture is drawn, the served page shows a stored picture of the model that it starts with (docs/web.md).
import { $ } from '../base/dom.js';
import { fromFragment } from '../words/state.js';
import { on } from '../shared/app.js';

const poster = new Image();
if (!ONE_FILE && !$('served') && !fromFragment(location.hash)) {
  Object.assign(poster, { id: 'poster', alt: '', src: 'start.webp' });
  $('view').prepend(poster);
}
for (const event of ['picture', 'idle']) on(event, () => poster.remove());
