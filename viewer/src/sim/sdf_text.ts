/** Elements of models in the text of a world. */

const TAG =
  /<!--[\s\S]*?-->|<!\[CDATA\[[\s\S]*?\]\]>|<(\/?)([\w:.-]+)((?:[^>"']|"[^"]*"|'[^']*')*)>/g;

const NAME = /\bname\s*=\s*(?:"([^"]*)"|'([^']*)')/;

const ENTITIES: Record<string, string> = {
  '&lt;': '<',
  '&gt;': '>',
  '&amp;': '&',
  '&quot;': '"',
  '&apos;': "'",
};
const decoded = (text: string) => text.replace(/&(?:lt|gt|amp|quot|apos);/g, (e) => ENTITIES[e]!);
const encoded = (text: string) => text.replace(/[<>&"]/g, (c) => `&#${c.charCodeAt(0)};`);

/** Models of a world, nested ones excluded: their elements by name. */
export function modelsIn(worldSdf: string): Map<string, string> {
  const out = new Map<string, string>();
  let depth = 0;
  let open: { name: string; from: number; depth: number } | undefined;
  for (const match of worldSdf.matchAll(TAG)) {
    const [tag, slash, element, attributes = ''] = match;
    if (!element) continue;
    const isClosed = attributes.trimEnd().endsWith('/');
    if (slash) {
      depth--;
      if (open && depth === open.depth) {
        out.set(open.name, worldSdf.slice(open.from, match.index + tag.length));
        open = undefined;
      }
      continue;
    }
    if (element === 'model' && !open) {
      const found = NAME.exec(attributes);
      const name = decoded(found?.[1] ?? found?.[2] ?? '');
      if (isClosed) out.set(name, tag);
      else open = { name, from: match.index, depth };
    }
    if (!isClosed) depth++;
  }
  return out;
}

/** Pose of a model by its element: position [m], and roll, pitch and yaw [rad]; zeros without one. */
export function poseIn(model: string): number[] {
  const zeros = [0, 0, 0, 0, 0, 0];
  let depth = 0;
  for (const match of model.matchAll(TAG)) {
    const [tag, slash, element, attributes = ''] = match;
    if (!element) continue;
    const isClosed = attributes.trimEnd().endsWith('/');
    if (slash) depth--;
    else if (depth === 1 && element === 'pose' && !isClosed) {
      const from = match.index + tag.length;
      const text = model.slice(from, model.indexOf('<', from)).trim();
      const numbers = text === '' ? zeros : text.split(/\s+/).map(Number);
      if (numbers.length !== 6 || !numbers.every(Number.isFinite)) throw new Error(text);
      const unit = /\bdegrees\s*=\s*["'](true|1)["']/.test(attributes) ? Math.PI / 180 : 1;
      return numbers.map((value, k) => (k < 3 ? value : value * unit));
    } else if (!isClosed) depth++;
  }
  return zeros;
}

/** File with one model of a world; `undefined` if the world has no such model. */
export function modelSdf(worldSdf: string, model: string): string | undefined {
  const element = modelsIn(worldSdf).get(model);
  if (!element) return undefined;
  const version = /<sdf\s[^>]*version\s*=\s*["']([\d.]+)["']/.exec(worldSdf)?.[1] ?? '1.9';
  return `<?xml version="1.0"?>\n<sdf version="${version}">\n${element}\n</sdf>\n`;
}

/** Replaces the name of the model in a file with one model. */
export function renamed(sdf: string, name: string): string {
  return sdf.replace(/<(?:model|robot)\b(?:[^>"']|"[^"]*"|'[^']*')*>/, (tag) =>
    tag.replace(NAME, () => `name="${encoded(name)}"`),
  );
}

/** Name that is not taken: the name itself, otherwise with a number, as Gazebo does. */
export function freeName(name: string, taken: ReadonlySet<string>): string {
  if (!taken.has(name)) return name;
  const stem = name.replace(/_\d+$/, '');
  for (let i = 0; ; i++) {
    const next = `${stem}_${i}`;
    if (!taken.has(next)) return next;
  }
}
