/** Reader of model files that the user opens. */
import { t } from '../texts/language.svelte';

export function readModelText(text: string, fileName: string): { name: string; sdf: string } {
  const isSdf = /<sdf\b/.test(text);
  const isUrdf = /<robot\b/.test(text);
  if (!isSdf && !isUrdf) throw new Error(t().world.notModelFile);
  const name = (isSdf ? /<model\s[^>]*name=["']([^"']+)/ : /<robot\s[^>]*name=["']([^"']+)/).exec(
    text,
  )?.[1];
  if (!name) throw new Error(t().world.noModelName);
  return { name: name || fileName.replace(/\.\w+$/, ''), sdf: text };
}
