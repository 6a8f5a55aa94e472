/** A model from a file of the user. */

export function readModelText(text: string, fileName: string): { name: string; sdf: string } {
  const isSdf = /<sdf\b/.test(text);
  const isUrdf = /<robot\b/.test(text);
  if (!isSdf && !isUrdf) throw new Error('This is neither SDF nor URDF');
  const name = (isSdf ? /<model\s[^>]*name=["']([^"']+)/ : /<robot\s[^>]*name=["']([^"']+)/).exec(
    text,
  )?.[1];
  if (!name) throw new Error('It has no <model> with a name');
  return { name: name || fileName.replace(/\.\w+$/, ''), sdf: text };
}
