// gallery.js: the gallery of a folder. It shows pictures of the folder's models, and can be searched, sorted, and used by
// keys. The search and the sort order are kept for the browser tab, so that a model's page leads back to the same list.
const list = document.querySelector('ul'), items = [...list.children], search = document.getElementById('search'), order = document.getElementById('order');
const count = document.getElementById('count'), AT_ONCE = 4;

for (const item of items) item.name = item.querySelector('a').dataset.name;

// --- pictures: the pictures in the window are drawn first, and only a few at the same time

const seen = new Set();
let running = 0;

async function draw(item) {
  running++;
  item.state = 'drawing';
  const image = item.querySelector('img');
  try {
    const answer = await fetch(image.dataset.thumb);
    item.failed = answer.status !== 200;
    const picture = await answer.blob();
    if (item.failed) image.alt = new DOMParser().parseFromString(await picture.text(), 'image/svg+xml').querySelector('title')?.textContent ?? '';
    image.src = URL.createObjectURL(picture);
    image.onload = () => URL.revokeObjectURL(image.src);
    item.state = 'drawn';
  } catch {
    item.state = 'lost'; // the viewer has ended
  }
  running--;
  if (order.value === 'failed' && item.failed) arrange();
  drawMore();
}

function drawMore() {
  while (running < AT_ONCE) {
    const waiting = (item) => !item.state && !item.hidden, next = [...seen].find(waiting) ?? (order.value === 'failed' ? items.find(waiting) : null);
    if (!next) return;
    draw(next);
  }
}

const watcher = new IntersectionObserver((entries) => {
  for (const { target, isIntersecting } of entries) isIntersecting ? seen.add(target) : seen.delete(target);
  drawMore();
}, { rootMargin: '200px' });
for (const item of items) watcher.observe(item);

// --- search and order

const compareNames = new Intl.Collator(undefined, { numeric: true }).compare;
const orders = {
  name: (a, b) => compareNames(a.name, b.name),
  size: (a, b) => b.dataset.size - a.dataset.size || orders.name(a, b),
  date: (a, b) => b.dataset.time - a.dataset.time || orders.name(a, b),
  failed: (a, b) => Number(b.failed ?? false) - Number(a.failed ?? false) || orders.name(a, b),
};

function arrange() {
  const focused = document.activeElement;
  items.sort(orders[order.value]);
  list.append(...items);
  if (list.contains(focused)) focused.focus();
}

function find() {
  const words = search.value.toLowerCase().split(/\s+/);
  for (const item of items) item.hidden = !words.every((word) => item.name.toLowerCase().includes(word));
  const shown = items.filter((item) => !item.hidden).length;
  count.textContent = `${shown === items.length ? '' : `${shown} of `}${items.length} ${items.length === 1 ? 'model' : 'models'}`;
  remember();
  drawMore();
}

function remember() {
  try {
    sessionStorage.setItem('lambent-gallery', JSON.stringify({ search: search.value, order: order.value }));
  } catch {
    // the page may be denied storage
  }
}

try {
  const kept = JSON.parse(sessionStorage.getItem('lambent-gallery') ?? '{}');
  search.value = kept.search ?? '';
  if (orders[kept.order]) order.value = kept.order;
} catch {
  // the stored text may come from another page
}
search.oninput = find;
order.onchange = () => {
  arrange();
  remember();
  drawMore();
};
arrange();
find();

// --- keys: the key / starts a search, and the arrow keys go from model to model

addEventListener('keydown', (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  if (event.key === '/' && document.activeElement !== search) (search.focus(), event.preventDefault());
  if (event.key === 'Escape' && search.value) (search.value = '', find());
  const links = items.filter((item) => !item.hidden).map((item) => item.querySelector('a')), at = links.indexOf(document.activeElement);
  if (event.key === 'ArrowDown' && document.activeElement === search && links.length) (links[0].focus(), event.preventDefault());
  if (at < 0) return;
  const columns = Math.max(1, links.findIndex((link) => link.getBoundingClientRect().top > links[0].getBoundingClientRect().top + 1));
  const to = { ArrowLeft: at - 1, ArrowRight: at + 1, ArrowUp: at - columns, ArrowDown: at + columns, Home: 0, End: links.length - 1 }[event.key];
  if (to === undefined) return;
  (to < 0 && event.key === 'ArrowUp' ? search : links[Math.max(0, Math.min(links.length - 1, to))]).focus();
  event.preventDefault();
});
