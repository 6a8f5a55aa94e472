/** Fields of topics that are dragged from a tree of messages into a plot or table. */
import type { FieldRef } from '../plots/expression';

/** Type of a dragged field, beside plain text. */
export const FIELD_TYPE = 'application/x-periplus-field';

export function dragField(event: DragEvent, ref: FieldRef): void {
  event.dataTransfer?.setData(FIELD_TYPE, JSON.stringify(ref));
  event.dataTransfer?.setData('text/plain', `${ref.topic}:${ref.path}`);
}

/** Field that was dropped; `undefined` if something else was. */
export function droppedField(event: DragEvent): FieldRef | undefined {
  const text = event.dataTransfer?.getData(FIELD_TYPE);
  if (!text) return undefined;
  const { topic, path } = JSON.parse(text) as Partial<FieldRef>;
  return typeof topic === 'string' && typeof path === 'string' ? { topic, path } : undefined;
}
