// "Run it here": the simulator in the page, where the site has the page without a server beside it (docs/tab.md).
// A place for it is `<div class="run-here" data-session="NAME"></div>`; without a name it is the demo.
(async () => {
  const places = document.querySelectorAll('.run-here');
  if (places.length === 0) return;
  const page = new URL(`${path_to_root}run/index.html`, document.baseURI);
  const isThere = await fetch(page, { method: 'HEAD' }).then((it) => it.ok, () => false);
  if (!isThere) return;
  for (const place of places) {
    const address = new URL(page);
    const { session } = place.dataset;
    if (session) address.searchParams.set('session', session);
    const start = document.createElement('button');
    start.textContent = 'Run it here';
    const link = document.createElement('a');
    link.href = address;
    link.target = '_blank';
    link.rel = 'noopener';
    link.textContent = 'Open it in a tab';
    start.addEventListener('click', () => {
      const frame = document.createElement('iframe');
      frame.src = address;
      frame.title = 'Periplus in this page';
      frame.allow = 'fullscreen; clipboard-write';
      start.replaceWith(frame);
    });
    place.append(start, link);
  }
})();
