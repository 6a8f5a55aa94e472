/** Elements of the panels. They outlive changes of the layout: a canvas that moves keeps its picture. */
import { mount, unmount } from 'svelte';
import type { App } from '../app/app.svelte';
import type { Driver } from '../app/driver.svelte';
import type { Panel } from '../app/panel.svelte';
import type { Tools } from '../app/tools.svelte';
import PanelFrame from './PanelFrame.svelte';

export class Frames {
  private all = new Map<Panel, { element: HTMLElement; frame?: Record<string, unknown> }>();

  constructor(private props: { app: App; tools: Tools; driver: Driver }) {}

  of(panel: Panel): HTMLElement {
    const found = this.all.get(panel);
    if (found) return found.element;
    const element = document.createElement('div');
    element.className = 'panel-frame';
    const one: { element: HTMLElement; frame?: Record<string, unknown> } = { element };
    this.all.set(panel, one);
    // Later: what is mounted inside of an effect ends with it, and the panel outlives the layout.
    queueMicrotask(() => {
      if (this.all.get(panel) !== one) return;
      one.frame = mount(PanelFrame, { target: element, props: { ...this.props, panel } });
    });
    return element;
  }

  /** Ends the panels that are not open any more. */
  keep(open: readonly Panel[]): void {
    for (const [panel, { element, frame }] of this.all) {
      if (open.includes(panel)) continue;
      this.all.delete(panel);
      element.remove();
      if (frame) void unmount(frame);
    }
  }
}
