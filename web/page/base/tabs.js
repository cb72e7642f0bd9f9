// tabs.js: adds and selects the panels beside the picture. addTab(id, label) returns the element that a module fills: #panel-ID, with the tab #tab-ID. `opened`
// is called with this element when the tab is shown for the first time.
import { $, element } from './dom.js';

const tabs = [];

export function addTab(id, label, opened = null) {
  const tab = element('button', { type: 'button', id: `tab-${id}`, textContent: label, tabIndex: -1,
    attributes: { role: 'tab', 'aria-selected': 'false', 'aria-controls': `panel-${id}` } });
  const panel = element('section', { id: `panel-${id}`, hidden: true, attributes: { role: 'tabpanel', 'aria-labelledby': tab.id } });
  tab.onclick = () => {
    selectTab(id);
    bringUp();
  };
  tabs.push({ id, tab, panel, opened });
  $('tabs').append(tab);
  $('panels').append(panel);
  if (tabs.length === 1) selectTab(id);
  return panel;
}

// In a narrow window, the tabs are below the picture, and the picture stays visible during scrolling. This function scrolls until the tabs are next to the
// picture.
function bringUp() {
  const below = $('stage').getBoundingClientRect().bottom, { top } = $('tabs').getBoundingClientRect();
  if (getComputedStyle($('stage')).position === 'sticky' && top > below) scrollBy(0, top - below);
}

// `focus` means that the tab gets the focus, because the user has pressed a key. If the page itself selects a tab, the focus stays unchanged.
export function selectTab(id, focus = false) {
  for (const one of tabs) {
    const chosen = one.id === id;
    one.tab.setAttribute('aria-selected', String(chosen));
    one.tab.tabIndex = chosen ? 0 : -1;
    one.panel.hidden = !chosen;
    if (chosen && focus) one.tab.focus();
    if (!chosen || !one.opened) continue;
    one.opened(one.panel);
    one.opened = null;
  }
}

$('tabs').addEventListener('keydown', (event) => {
  const at = tabs.findIndex(({ tab }) => tab === document.activeElement);
  const to = { ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: tabs.length - 1 }[event.key];
  if (at < 0 || to === undefined) return;
  selectTab(tabs[(to + tabs.length) % tabs.length].id, true);
  event.preventDefault();
});
