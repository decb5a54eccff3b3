// Ways through the page: the objects in the top bar, the parts of an object in a bar of its own that stays while one reads it.

function fillNavigation() {
  const links = report.objects.map((object, i) => {
    const scene = sceneOf(object);
    const alone = report.objects.filter((other) => other.name === object.name).length === 1;
    return element('a', {href: `#object-${i}`, title: sceneTitle(scene)}, alone ? object.name : `${object.name} (${scene.clip || scene.scene})`);
  });
  document.getElementById('nav').append(element('a', {href: '#content'}, 'Summary'), ...links, element('a', {href: '#meaning'}, 'What the numbers mean'));
  followReading(document.querySelectorAll('#nav a'));
}

/** The name of an object and links to its parts: every card with a title in `parts`. */
function objectBar(object, index, parts) {
  const cards = parts.flatMap((part) => (part.matches('.card') ? [part] : [...part.querySelectorAll('.card')]));
  const titled = cards.map((card) => ({card, title: card.querySelector('h3')?.textContent})).filter(({title}) => title);
  const links = titled.map(({card, title}) => {
    card.id ||= `object-${index}-${title.toLowerCase().replace(/[^a-z0-9]+/g, '-')}`;
    return element('a', {href: `#${card.id}`}, title);
  });
  requestAnimationFrame(() => followReading(links));
  return element('div', {class: 'object-bar'}, element('h2', {id: `object-${index}-name`}, object.name),
    element('nav', {'aria-label': `Parts of the report on ${object.name}`}, ...links));
}

/** Marks the link to what is being read: the last target that begins in the upper third of the window. */
function followReading(links) {
  const targets = [...links].map((link) => ({link, target: document.getElementById(link.hash.slice(1))})).filter(({target}) => target);
  let marked;
  const mark = () => {
    const above = targets.filter(({target}) => target.getBoundingClientRect().top < innerHeight / 3);
    const current = above[above.length - 1]?.link;
    if (current === marked) return;
    marked?.removeAttribute('aria-current');
    current?.setAttribute('aria-current', 'true');
    marked = current;
    if (current) showWithin(current.closest('nav'), current);
  };
  let waiting = false;
  addEventListener('scroll', () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      mark();
    });
  }, {passive: true});
  mark();
}

/** Moves a bar that is wider than its window, and the bar alone, until a link stands in its middle. */
function showWithin(bar, link) {
  const [outer, inner] = [bar.getBoundingClientRect(), link.getBoundingClientRect()];
  bar.scrollLeft += (inner.left + inner.right - outer.left - outer.right) / 2;
}
