// viewer.js: additional functions of the page of `lambent view` (served.js). It draws the picture again when a file changes, shows the model's name in the
// title, and links to the gallery. Only that page fetches this module.
import { emit, on, refuse, say, state, view } from '../shared/app.js';
import { $, element } from '../base/dom.js';
import { giveUpPicture, nativeReason, served, watchServed } from '../worker/served.js';
import { text } from '../base/strings.js';

const showTitle = () => (document.title = `${state.model.replace(/^.*\//, '')} · Lambent`);

view.giveUpPicture = giveUpPicture;
if (served.gallery) $('model').parentElement.before(element('a', { id: 'gallery', href: './', textContent: text('gallery') }));
showTitle();
on('words', showTitle);
on('picture', () => {
  const reason = nativeReason(state.model);
  if (reason) $('status').textContent += ` · ${text('drawnByProgram', { reason })}`;
});
watchServed(
  () => {
    say(text('fileChanged'));
    emit('words');
  },
  (isLost) => isLost && refuse(text('viewerEnded')),
);
