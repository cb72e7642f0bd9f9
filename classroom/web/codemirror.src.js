// codemirror.src.js: imports the modules of CodeMirror 6 (npm, MIT) that the page uses, and makes an editor with them. esbuild bundles them into codemirror.js
// (web/build.py). CodeMirror's styles are added to the shadow root of the editor's element, because the page's content security policy allows them there.
import { autocompletion } from '@codemirror/autocomplete';
import { indentWithTab } from '@codemirror/commands';
import { HighlightStyle, StreamLanguage, syntaxHighlighting } from '@codemirror/language';
import { shader } from '@codemirror/legacy-modes/mode/clike';
import { lintGutter, setDiagnostics } from '@codemirror/lint';
import { EditorState } from '@codemirror/state';
import { EditorView, keymap } from '@codemirror/view';
import { tags } from '@lezer/highlight';
import { basicSetup } from 'codemirror';

const colors = HighlightStyle.define([
  { tag: [tags.keyword, tags.typeName, tags.standard(tags.name)], color: 'var(--accent)' },
  { tag: tags.comment, color: 'var(--soft)', fontStyle: 'italic' },
  { tag: [tags.number, tags.meta], color: 'var(--bad)' },
]);
const theme = EditorView.theme({
  '&': { color: 'var(--front)', backgroundColor: 'var(--field)', fontSize: '.8rem', maxHeight: '17rem', border: '1px solid var(--line)', borderRadius: '6px' },
  '&.cm-focused': { outline: '2px solid var(--accent)' },
  '.cm-scroller': { overflow: 'auto', fontFamily: 'ui-monospace, monospace' },
  '.cm-content': { caretColor: 'var(--front)' },
  '.cm-cursor': { borderLeftColor: 'var(--front)' },
  '.cm-gutters': { color: 'var(--soft)', backgroundColor: 'var(--back)', borderRight: '1px solid var(--line)' },
  '.cm-activeLine, .cm-activeLineGutter': { backgroundColor: 'color-mix(in srgb, var(--accent) 8%, transparent)' },
  '.cm-selectionBackground, &.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground': { backgroundColor: 'color-mix(in srgb, var(--accent) 30%, transparent)' },
  '.cm-tooltip, .cm-panels': { color: 'var(--front)', backgroundColor: 'var(--back)' },
});

// Chromium replaces a selection of several lines by a <span> with a style attribute, which the page's content security policy blocks.
function replaceLines(event, view) {
  const { main } = view.state.selection, { doc } = view.state;
  if (event.inputType !== 'insertText' || !event.data || doc.lineAt(main.from).number === doc.lineAt(main.to).number) return false;
  event.preventDefault();
  view.dispatch({ ...view.state.replaceSelection(event.data), userEvent: 'input.type', scrollIntoView: true });
  return true;
}

// Makes an editor in `place`. Its `text` can be read and set, showErrors([{line, text}]) shows the messages of a compiler, and goTo(line) scrolls to a line.
export function makeEditor(place, { label, onchange }) {
  const root = place.attachShadow({ mode: 'open' });
  let silent = false;
  const view = new EditorView({
    root,
    parent: root,
    state: EditorState.create({
      // Completions appear only if the user asks for them (Ctrl-Space): otherwise they would cover messages and take Enter.
      extensions: [basicSetup, autocompletion({ activateOnTyping: false }), EditorView.domEventHandlers({ beforeinput: replaceLines }), keymap.of([indentWithTab]), StreamLanguage.define(shader), syntaxHighlighting(colors), theme, lintGutter(),
        EditorView.contentAttributes.of({ 'aria-label': label, tabindex: '0' }), EditorView.updateListener.of((update) => update.docChanged && !silent && onchange())],
    }),
  });
  return {
    get text() {
      return view.state.doc.toString();
    },
    set text(value) {
      silent = true;
      view.dispatch({ changes: { from: 0, to: view.state.doc.length, insert: value } });
      silent = false;
    },
    showErrors(errors) {
      const { doc } = view.state;
      const at = (line) => doc.line(Math.min(Math.max(line, 1), doc.lines));
      view.dispatch(setDiagnostics(view.state, errors.map(({ line, text }) => ({ from: at(line).from, to: at(line).to, severity: 'error', message: text }))));
    },
    goTo(line) {
      const { from } = view.state.doc.line(Math.min(line, view.state.doc.lines));
      view.dispatch({ selection: { anchor: from }, scrollIntoView: true });
      view.focus();
    },
  };
}
