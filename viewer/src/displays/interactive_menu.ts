/** Menu of an interactive marker: a list beside the pointer, by mouse, touch and keyboard. */
import type { MenuEntry, MenuNode } from './interactive_messages';

const STYLE =
  'position:fixed;z-index:30;min-width:140px;max-height:70vh;overflow:auto;padding:4px;' +
  'border:1px solid var(--line);border-radius:var(--radius);background:var(--panel);' +
  'box-shadow:var(--shadow);display:flex;flex-direction:column';

/** Shows a menu at a point of the page; `choose` is called with the entry. Returns a function that closes it. */
export function openMenu(
  nodes: readonly MenuNode[],
  name: string,
  at: { clientX: number; clientY: number },
  choose: (entry: MenuEntry) => void,
): () => void {
  const menu = document.createElement('div');
  menu.role = 'menu';
  menu.ariaLabel = name;
  menu.style.cssText = STYLE;
  const before = document.activeElement as HTMLElement | null;
  const close = () => {
    window.removeEventListener('pointerdown', outside, true);
    menu.remove();
    before?.focus?.();
  };
  const outside = (event: Event) => {
    if (!menu.contains(event.target as Node)) close();
  };
  const show = (list: readonly MenuNode[], back?: () => void) => {
    menu.replaceChildren();
    if (back) menu.append(item('‹', back));
    for (const node of list) {
      const { title } = node.entry;
      // A checked entry of interactive_markers' MenuHandler begins with "[x] ".
      if (node.children.length === 0) {
        menu.append(
          item(title, () => {
            close();
            choose(node.entry);
          }),
        );
      } else menu.append(item(`${title} ›`, () => show(node.children, () => show(list, back))));
    }
    (menu.firstElementChild as HTMLElement | null)?.focus();
  };
  menu.addEventListener('keydown', (event) => {
    const items = [...menu.children] as HTMLElement[];
    const now = items.indexOf(document.activeElement as HTMLElement);
    const by = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (by) items[(now + by + items.length) % items.length]?.focus();
    else if (event.key === 'Escape') close();
    else return;
    event.preventDefault();
    event.stopPropagation();
  });
  document.body.append(menu);
  show(nodes);
  const { width, height } = menu.getBoundingClientRect();
  menu.style.left = `${Math.max(4, Math.min(at.clientX, innerWidth - width - 4))}px`;
  menu.style.top = `${Math.max(4, Math.min(at.clientY, innerHeight - height - 4))}px`;
  window.addEventListener('pointerdown', outside, true);
  return close;
}

function item(text: string, action: () => void): HTMLButtonElement {
  const button = document.createElement('button');
  button.role = 'menuitem';
  button.className = 'ghost';
  button.style.justifyContent = 'flex-start';
  button.textContent = text;
  button.addEventListener('click', action);
  return button;
}
