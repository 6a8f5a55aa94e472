/** Reader of model files that the user opens. */

export function readModelText(text: string, fileName: string): { name: string; sdf: string } {
  const isSdf = /<sdf\b/.test(text);
  const isUrdf = /<robot\b/.test(text);
  if (!isSdf && !isUrdf) throw new Error('The file is neither SDF nor URDF');
  const name = (isSdf ? /<model\s[^>]*name=["']([^"']+)/ : /<robot\s[^>]*name=["']([^"']+)/).exec(
    text,
  )?.[1];
  if (!name) throw new Error('The file has no <model> or <robot> with a name');
  return { name: name || fileName.replace(/\.\w+$/, ''), sdf: text };
}
