/** Chart of a value against another: path.x against path.y. */
import { shortNumber, ticks } from './ticks';
import type { ChartStyle } from './time_chart';

export interface XYLine {
  label: string;
  color: string;
  times: ArrayLike<number>;
  xs: ArrayLike<number>;
  ys: ArrayLike<number>;
}

export interface Box {
  x0: number;
  x1: number;
  y0: number;
  y1: number;
}

/** Point of a curve near the pointer. */
export interface Found {
  label: string;
  timeS: number;
  x: number;
  y: number;
}

const HEIGHT_PX = 280;
const MARGIN = { left: 52, right: 10, top: 8, bottom: 34 };
const REACH_PX = 24;
const WHEEL_FACTOR = 1.2;

/** Box around all points, with a margin; of at least some size, so that a point has a scale. */
export function boxOf(lines: readonly XYLine[]): Box {
  const box = { x0: Infinity, x1: -Infinity, y0: Infinity, y1: -Infinity };
  for (const { xs, ys } of lines) {
    for (let i = 0; i < xs.length; i++) {
      const [x, y] = [xs[i]!, ys[i]!];
      if (!Number.isFinite(x) || !Number.isFinite(y)) continue;
      box.x0 = Math.min(box.x0, x);
      box.x1 = Math.max(box.x1, x);
      box.y0 = Math.min(box.y0, y);
      box.y1 = Math.max(box.y1, y);
    }
  }
  if (!Number.isFinite(box.x0)) return { x0: 0, x1: 1, y0: 0, y1: 1 };
  const padX = Math.max((box.x1 - box.x0) * 0.05, 1e-3);
  const padY = Math.max((box.y1 - box.y0) * 0.05, 1e-3);
  return { x0: box.x0 - padX, x1: box.x1 + padX, y0: box.y0 - padY, y1: box.y1 + padY };
}

/** Box of the same centre in which a unit has the same length in both directions. */
export function squared(box: Box, width: number, height: number): Box {
  const scale = Math.max((box.x1 - box.x0) / width, (box.y1 - box.y0) / height);
  const [x, y] = [(box.x0 + box.x1) / 2, (box.y0 + box.y1) / 2];
  const [w, h] = [(scale * width) / 2, (scale * height) / 2];
  return { x0: x - w, x1: x + w, y0: y - h, y1: y + h };
}

export class XYChart {
  readonly canvas = document.createElement('canvas');
  /** Box that the user chose; otherwise all points are shown. */
  private chosen?: Box;
  private box: Box = { x0: 0, x1: 1, y0: 0, y1: 1 };
  private lines: readonly XYLine[] = [];
  private labels = { x: '', y: '' };
  private isSquare = true;
  private markS?: number;
  private observer: ResizeObserver;

  constructor(
    private holder: HTMLElement,
    private style: () => ChartStyle,
    private found: (point: Found | undefined) => void,
    private click: (timeS: number) => void,
  ) {
    holder.append(this.canvas);
    this.canvas.style.cssText = `width:100%;height:${HEIGHT_PX}px;touch-action:pan-y`;
    this.observer = new ResizeObserver(() => this.draw());
    this.observer.observe(holder);
    this.listen();
  }

  update(
    lines: readonly XYLine[],
    labels: { x: string; y: string },
    isSquare: boolean,
    markS: number | undefined,
  ): void {
    this.lines = lines;
    this.labels = labels;
    this.isSquare = isSquare;
    this.markS = markS;
    this.draw();
  }

  private get area() {
    const width = Math.max(1, this.holder.clientWidth - MARGIN.left - MARGIN.right);
    return { width, height: HEIGHT_PX - MARGIN.top - MARGIN.bottom };
  }

  private toX = (x: number) =>
    MARGIN.left + ((x - this.box.x0) / (this.box.x1 - this.box.x0)) * this.area.width;
  private toY = (y: number) =>
    MARGIN.top + ((this.box.y1 - y) / (this.box.y1 - this.box.y0)) * this.area.height;

  private draw(): void {
    const ratio = window.devicePixelRatio || 1;
    const width = this.holder.clientWidth;
    this.canvas.style.display = this.lines.length === 0 ? 'none' : 'block';
    if (width === 0 || this.lines.length === 0) return;
    this.canvas.width = width * ratio;
    this.canvas.height = HEIGHT_PX * ratio;
    const context = this.canvas.getContext('2d')!;
    context.scale(ratio, ratio);
    const { width: w, height: h } = this.area;
    this.box = this.chosen ?? boxOf(this.lines);
    if (this.isSquare) this.box = squared(this.box, w, h);
    this.drawAxes(context);
    context.save();
    context.beginPath();
    context.rect(MARGIN.left, MARGIN.top, w, h);
    context.clip();
    for (const line of this.lines) this.drawLine(context, line);
    context.restore();
  }

  private drawAxes(context: CanvasRenderingContext2D): void {
    const { soft, line } = this.style();
    const { width: w, height: h } = this.area;
    const { box } = this;
    context.font = '11px system-ui';
    context.fillStyle = soft;
    context.strokeStyle = line;
    context.textAlign = 'center';
    context.textBaseline = 'top';
    for (const x of ticks(box.x0, box.x1, w / 70)) {
      const at = Math.round(this.toX(x)) + 0.5;
      line2(context, at, MARGIN.top, at, MARGIN.top + h);
      context.fillText(shortNumber(x), at, MARGIN.top + h + 4);
    }
    context.textAlign = 'right';
    context.textBaseline = 'middle';
    for (const y of ticks(box.y0, box.y1, h / 36)) {
      const at = Math.round(this.toY(y)) + 0.5;
      line2(context, MARGIN.left, at, MARGIN.left + w, at);
      context.fillText(shortNumber(y), MARGIN.left - 5, at);
    }
    context.textAlign = 'center';
    context.textBaseline = 'bottom';
    context.fillText(this.labels.x, MARGIN.left + w / 2, HEIGHT_PX - 2);
    context.save();
    context.translate(2, MARGIN.top + h / 2);
    context.rotate(-Math.PI / 2);
    context.textBaseline = 'top';
    context.fillText(this.labels.y, 0, 0);
    context.restore();
  }

  private drawLine(context: CanvasRenderingContext2D, { xs, ys, times, color }: XYLine): void {
    context.strokeStyle = context.fillStyle = color;
    context.lineWidth = 1.5;
    context.beginPath();
    let isDown = false;
    let at = -1;
    for (let i = 0; i < xs.length; i++) {
      const [x, y] = [xs[i]!, ys[i]!];
      if (!Number.isFinite(x) || !Number.isFinite(y)) {
        isDown = false;
        continue;
      }
      if (this.markS === undefined || times[i]! <= this.markS) at = i;
      if (isDown) context.lineTo(this.toX(x), this.toY(y));
      else context.moveTo(this.toX(x), this.toY(y));
      isDown = true;
    }
    context.stroke();
    if (at < 0) return;
    // The present point, or the last one before the marked time.
    context.beginPath();
    context.arc(this.toX(xs[at]!), this.toY(ys[at]!), 4, 0, 2 * Math.PI);
    context.fill();
  }

  private listen(): void {
    const { canvas } = this;
    let from: { x: number; y: number; box: Box } | undefined;
    let isMoved = false;
    canvas.addEventListener('pointerdown', (event) => {
      from = { x: event.clientX, y: event.clientY, box: { ...this.box } };
      isMoved = false;
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener('pointermove', (event) => {
      if (!from) {
        this.found(this.nearest(event));
        return;
      }
      const [dx, dy] = [event.clientX - from.x, event.clientY - from.y];
      if (Math.hypot(dx, dy) < 4 && !isMoved) return;
      isMoved = true;
      const byX = (-dx / this.area.width) * (from.box.x1 - from.box.x0);
      const byY = (dy / this.area.height) * (from.box.y1 - from.box.y0);
      const { x0, x1, y0, y1 } = from.box;
      this.choose({ x0: x0 + byX, x1: x1 + byX, y0: y0 + byY, y1: y1 + byY });
    });
    canvas.addEventListener('pointerup', (event) => {
      const point = from && !isMoved ? this.nearest(event) : undefined;
      from = undefined;
      this.found(this.nearest(event));
      if (point) this.click(point.timeS);
    });
    canvas.addEventListener('pointercancel', () => (from = undefined));
    canvas.addEventListener('pointerleave', () => this.found(undefined));
    canvas.addEventListener('dblclick', () => this.reset());
    canvas.addEventListener(
      'wheel',
      (event) => {
        event.preventDefault();
        const at = canvas.getBoundingClientRect();
        this.zoom(event.deltaY > 0 ? WHEEL_FACTOR : 1 / WHEEL_FACTOR, {
          u: (event.clientX - at.left - MARGIN.left) / this.area.width,
          v: 1 - (event.clientY - at.top - MARGIN.top) / this.area.height,
        });
      },
      { passive: false },
    );
  }

  /** Zooms around a point given as fractions of the width and height. */
  zoom(factor: number, { u, v } = { u: 0.5, v: 0.5 }): void {
    const { x0, x1, y0, y1 } = this.box;
    const [x, y] = [x0 + u * (x1 - x0), y0 + v * (y1 - y0)];
    this.choose({
      x0: x - (x - x0) * factor,
      x1: x + (x1 - x) * factor,
      y0: y - (y - y0) * factor,
      y1: y + (y1 - y) * factor,
    });
  }

  pan(u: number, v: number): void {
    const { x0, x1, y0, y1 } = this.box;
    const [dx, dy] = [u * (x1 - x0), v * (y1 - y0)];
    this.choose({ x0: x0 + dx, x1: x1 + dx, y0: y0 + dy, y1: y1 + dy });
  }

  reset(): void {
    this.chosen = undefined;
    this.draw();
  }

  private choose(box: Box): void {
    this.chosen = box;
    this.draw();
  }

  private nearest(event: { clientX: number; clientY: number }): Found | undefined {
    const at = this.canvas.getBoundingClientRect();
    const [px, py] = [event.clientX - at.left, event.clientY - at.top];
    let best: Found | undefined;
    let reach = REACH_PX;
    for (const { label, times, xs, ys } of this.lines) {
      for (let i = 0; i < xs.length; i++) {
        const distance = Math.hypot(this.toX(xs[i]!) - px, this.toY(ys[i]!) - py);
        if (!(distance < reach)) continue;
        reach = distance;
        best = { label, timeS: times[i]!, x: xs[i]!, y: ys[i]! };
      }
    }
    return best;
  }

  stop(): void {
    this.observer.disconnect();
    this.canvas.remove();
  }
}

function line2(
  context: CanvasRenderingContext2D,
  x0: number,
  y0: number,
  x1: number,
  y1: number,
): void {
  context.beginPath();
  context.moveTo(x0, y0);
  context.lineTo(x1, y1);
  context.stroke();
}
