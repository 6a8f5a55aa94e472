/**
 * Files of the page. All panels that are loaded later are one file: Brotli compresses one file of them better than
 * twenty small ones, and a second panel opens without waiting.
 */

interface Graph {
  getModuleInfo(id: string): ModuleInfo | null;
}

interface ModuleInfo {
  importedIds: readonly string[];
  dynamicallyImportedIds: readonly string[];
}

const isPanel = (id: string) => /\/src\/(panels|tab)\/\w+Panel\.svelte$/.test(id);

/** Modules that are loaded with these, themselves included. */
function loadedWith(roots: Iterable<string>, graph: Graph): Set<string> {
  const found = new Set(roots);
  for (const id of found) {
    for (const next of graph.getModuleInfo(id)?.importedIds ?? []) found.add(next);
  }
  return found;
}

/** Names the file of a module; `null` leaves the choice to the bundler. */
export function fileNames(main: string): (id: string, graph: Graph) => string | null {
  let ofPanels: Set<string> | undefined;
  return (id, graph) => {
    if (!ofPanels) {
      const first = loadedWith([main], graph);
      // Everything that is loaded at some time, and the places where it is.
      const all = new Set(first);
      const later = new Set<string>();
      for (const one of all) {
        for (const next of graph.getModuleInfo(one)?.dynamicallyImportedIds ?? []) {
          if (!first.has(next)) later.add(next);
          for (const module of loadedWith([next], graph)) all.add(module);
        }
      }
      const panels = [...later].filter(isPanel);
      const others = loadedWith(
        [...later].filter((one) => !isPanel(one)),
        graph,
      );
      ofPanels = new Set(
        [...loadedWith(panels, graph)].filter((one) => !first.has(one) && !others.has(one)),
      );
    }
    return ofPanels.has(id) ? 'panels' : null;
  };
}
