// shader_editor.js: makes an editor for a shader. It is CodeMirror, or a plain text field if the page was built without CodeMirror.
import { openCodeMirror } from './check_start.js';
import { element } from '../base/dom.js';

function plainEditor(place, { label, onchange }) {
  const field = element('textarea', { rows: 16, spellcheck: false, wrap: 'off', oninput: onchange, attributes: { 'aria-label': label, translate: 'no' } });
  place.append(field);
  return {
    get text() {
      return field.value;
    },
    set text(value) {
      field.value = value;
    },
    showErrors(errors) {
      field.setAttribute('aria-invalid', String(errors.length > 0));
    },
    goTo(line) {
      const from = field.value.split('\n').slice(0, line - 1).join('\n').length + (line > 1);
      field.focus();
      field.setSelectionRange(from, from);
    },
  };
}

// Makes an editor with `text`, showErrors([{line, text}]) and goTo(line). It calls `onchange` when the user changes the text.
export async function makeEditor(place, options) {
  const codeMirror = await openCodeMirror().catch(() => null);
  return codeMirror ? codeMirror.makeEditor(place, options) : plainEditor(place, options);
}
