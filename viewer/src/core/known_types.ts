/** Definitions of message types that the page has seen: of topics, and of the types that they contain. */
import { longName } from './schema';

const SEPARATOR = /^={3,}\s*$/m;

/** Types by their full names, each with a text that contains all types that it uses. */
export function knownTypes(
  channels: Iterable<{ schemaName: string; schema: string }>,
  own: Readonly<Record<string, string>> = {},
): Map<string, string> {
  const out = new Map<string, string>();
  const nested = new Map<string, string>();
  const all = [
    ...channels,
    ...Object.entries(own).map(([schemaName, schema]) => ({ schemaName, schema })),
  ];
  for (const { schemaName, schema } of all) {
    const name = longName(schemaName);
    if (!/^[\w]+\/msg\/\w+$/.test(name) || out.has(name)) continue;
    out.set(name, schema);
    const parts = schema.split(SEPARATOR);
    for (const part of parts) {
      const header = /^\s*MSG:\s*(\S+)\s*$/m.exec(part);
      if (!header) continue;
      const inner = longName(header[1]!);
      if (nested.has(inner)) continue;
      const body = part.replace(header[0], '').trim();
      const others = parts.filter((other) => other !== part && /^\s*MSG:/m.test(other));
      nested.set(
        inner,
        [body, ...others.map((other) => other.trim())].join(`\n${'='.repeat(80)}\n`),
      );
    }
  }
  for (const [name, text] of nested) if (!out.has(name)) out.set(name, text);
  return out;
}
