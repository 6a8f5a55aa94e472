/** Fields that other panels ask the plot panel to show. */
import type { FieldRef } from '../plots/expression';

/** Type of a dragged field, beside plain text. */
export const FIELD_TYPE = 'application/x-periplus-field';

class Plotting {
  /** Fields that no plot panel has taken yet. */
  wanted: FieldRef[] = $state.raw([]);
  /** Increases when a plot panel should be shown. */
  attention = $state(0);

  plot(ref: FieldRef): void {
    this.wanted = [...this.wanted, ref];
    this.attention++;
  }

  take(): FieldRef[] {
    const taken = this.wanted;
    if (taken.length > 0) this.wanted = [];
    return taken;
  }
}

export const plotting = new Plotting();

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
