/** Chart of curves over time: one y axis per unit, zoom, pan, a cursor shared by the charts of a panel. */
import type { Samples } from './expression';
import { indexAt } from './statistics';
import { shortNumber, ticks } from './ticks';

export interface Line {
  label: string;
  unit: string;
  color: string;
  samples: Samples;
}

export interface Span {
  fromS: number;
  toS: number;
}

export interface ChartEvents {
  /** The user zoomed or panned; `undefined`: show everything again. */
  span(span: Span | undefined): void;
  cursor(timeS: number | undefined): void;
  click(timeS: number): void;
}

export interface ChartStyle {
  soft: string;
  line: string;
  accent: string;
}

/** Scale of the values of one unit. */
export interface Scale {
  unit: string;
  min: number;
  max: number;
}

const HEIGHT_PX = 220;
const TOP_PX = 10;
const BOTTOM_PX = 36;
const AXIS_PX = 54;
const WHEEL_FACTOR = 1.2;
const CLICK_PX = 4;
const MIN_SPAN_S = 1e-5;
/** Larger times are shown from their first second, because digits of a date hide those that differ. */
const LONG_TIME_S = 1e6;
/** Time for which an offset is kept: labels that change hide the motion. */
const OFFSET_S = 3600;

/** Scales of the units, around the values that are visible. */
export function scalesOf(lines: readonly Line[], { fromS, toS }: Span): Scale[] {
  const out = new Map<string, Scale>();
  for (const { unit, samples } of lines) {
    let scale = out.get(unit);
    if (!scale) out.set(unit, (scale = { unit, min: Infinity, max: -Infinity }));
    const first = Math.max(0, indexAt(samples.times, fromS));
    const last = Math.min(samples.times.length - 1, indexAt(samples.times, toS) + 1);
    for (let i = first; i <= last; i++) {
      const value = samples.values[i]!;
      if (!Number.isFinite(value)) continue;
      scale.min = Math.min(scale.min, value);
      scale.max = Math.max(scale.max, value);
    }
  }
  return [...out.values()].map(({ unit, min, max }) => {
    if (min > max) return { unit, min: 0, max: 1 };
    // A constant value is drawn in the middle.
    const pad = max > min ? (max - min) * 0.06 : Math.max(Math.abs(max) * 0.1, 0.1);
    return { unit, min: min - pad, max: max + pad };
  });
}

/**
 * Points of a curve on the screen: of more than one sample per pixel the smallest and largest of each column, so that
 * no peak is lost.
 */
export function pointsOnScreen(
  { times, values }: Samples,
  { fromS, toS }: Span,
  toX: (timeS: number) => number,
  toY: (value: number) => number,
): (readonly [number, number] | undefined)[] {
  const out: (readonly [number, number] | undefined)[] = [];
  const first = Math.max(0, indexAt(times, fromS));
  const last = Math.min(times.length - 1, indexAt(times, toS) + 1);
  let column = NaN;
  let [low, high] = [NaN, NaN];
  const flush = () => {
    if (!Number.isNaN(low)) out.push([column, low]);
    if (high !== low && !Number.isNaN(high)) out.push([column, high]);
    [low, high] = [NaN, NaN];
  };
  const isDense = last - first > 4000;
  for (let i = first; i <= last; i++) {
    const value = values[i]!;
    if (!Number.isFinite(value)) {
      flush();
      out.push(undefined);
      continue;
    }
    const [x, y] = [toX(times[i]!), toY(value)];
    if (!isDense) {
      out.push([x, y]);
      continue;
    }
    if (Math.round(x) !== column) flush();
    column = Math.round(x);
    low = Number.isNaN(low) ? y : Math.min(low, y);
    high = Number.isNaN(high) ? y : Math.max(high, y);
  }
  flush();
  return out;
}

export class TimeChart {
  readonly canvas = document.createElement('canvas');
  private span: Span = { fromS: 0, toS: 1 };
  private lines: readonly Line[] = [];
  private scales: Scale[] = [];
  private markS?: number;
  private cursorS?: number;
  private offsetS = 0;
  /** Ends of a selection in the chart [px]. */
  private selection?: [number, number];
  private observer: ResizeObserver;
  private leave = new AbortController();

  constructor(
    private holder: HTMLElement,
    private events: ChartEvents,
    private style: () => ChartStyle,
    private timeLabel: (offsetS: number) => string,
  ) {
    holder.append(this.canvas);
    this.canvas.style.cssText = `display:block;width:100%;height:${HEIGHT_PX}px;touch-action:pan-y;cursor:crosshair`;
    this.observer = new ResizeObserver(() => this.draw());
    this.observer.observe(holder);
    this.listen();
  }

  update(
    lines: readonly Line[],
    span: Span,
    markS: number | undefined,
    cursorS: number | undefined,
  ): void {
    this.lines = lines;
    this.span = span;
    this.markS = markS;
    this.cursorS = cursorS;
    if (!(span.toS > LONG_TIME_S)) this.offsetS = 0;
    else if (Math.abs(span.fromS - this.offsetS) > OFFSET_S) this.offsetS = Math.floor(span.fromS);
    this.draw();
  }

  private get area() {
    const right = this.scales.filter((_, i) => i % 2 === 1).length * AXIS_PX;
    const left = Math.max(1, this.scales.length - right / AXIS_PX) * AXIS_PX;
    const width = Math.max(1, this.holder.clientWidth - left - Math.max(8, right));
    return { left, width, top: TOP_PX, height: HEIGHT_PX - TOP_PX - BOTTOM_PX };
  }

  private toX = (timeS: number) => {
    const { left, width } = this.area;
    return left + ((timeS - this.span.fromS) / (this.span.toS - this.span.fromS)) * width;
  };
  private toTime = (x: number) => {
    const { left, width } = this.area;
    return this.span.fromS + ((x - left) / width) * (this.span.toS - this.span.fromS);
  };
  private toY = ({ min, max }: Scale, value: number) => {
    const { top, height } = this.area;
    return top + ((max - value) / (max - min)) * height;
  };

  private draw(): void {
    const width = this.holder.clientWidth;
    const isEmpty = this.lines.length === 0;
    this.canvas.style.display = isEmpty ? 'none' : 'block';
    if (width === 0 || isEmpty) return;
    this.scales = scalesOf(this.lines, this.span);
    const ratio = window.devicePixelRatio || 1;
    this.canvas.width = width * ratio;
    this.canvas.height = HEIGHT_PX * ratio;
    const context = this.canvas.getContext('2d')!;
    context.scale(ratio, ratio);
    context.font = '11px system-ui';
    const style = this.style();
    this.drawTimeAxis(context, style);
    this.scales.forEach((scale, i) => this.drawAxis(context, style, scale, i));
    const { left, top, width: w, height: h } = this.area;
    context.save();
    context.beginPath();
    context.rect(left, top - 2, w, h + 4);
    context.clip();
    for (const line of this.lines) this.drawLine(context, line);
    if (this.markS !== undefined) vertical(context, this.toX(this.markS), top, h, style.accent, 2);
    if (this.cursorS !== undefined) {
      vertical(context, this.toX(this.cursorS), top, h, style.soft, 1, [4, 3]);
      this.drawDots(context, this.cursorS);
    }
    if (this.selection) {
      const [a, b] = this.selection;
      context.fillStyle = style.accent;
      context.globalAlpha = 0.2;
      context.fillRect(Math.min(a, b), top, Math.abs(b - a), h);
    }
    context.restore();
  }

  private drawTimeAxis(context: CanvasRenderingContext2D, { soft, line }: ChartStyle): void {
    const { left, top, width, height } = this.area;
    context.textAlign = 'center';
    context.textBaseline = 'top';
    const { fromS, toS } = this.span;
    for (const timeS of ticks(fromS - this.offsetS, toS - this.offsetS, width / 70)) {
      const x = Math.round(this.toX(timeS + this.offsetS)) + 0.5;
      vertical(context, x, top, height, line, 1);
      context.fillStyle = soft;
      context.fillText(shortNumber(timeS), x, top + height + 4);
    }
    context.fillStyle = soft;
    context.textBaseline = 'bottom';
    context.fillText(this.timeLabel(this.offsetS), left + width / 2, HEIGHT_PX - 2);
  }

  private drawAxis(
    context: CanvasRenderingContext2D,
    { soft, line }: ChartStyle,
    scale: Scale,
    index: number,
  ): void {
    const { left, top, width, height } = this.area;
    const isRight = index % 2 === 1;
    const step = Math.floor(index / 2) * AXIS_PX;
    const x = isRight ? left + width + step : left - step;
    context.textAlign = isRight ? 'left' : 'right';
    context.textBaseline = 'middle';
    for (const value of ticks(scale.min, scale.max, height / 34)) {
      const y = Math.round(this.toY(scale, value)) + 0.5;
      if (index === 0) {
        context.fillStyle = line;
        context.fillRect(left, y - 0.5, width, 1);
      }
      context.fillStyle = soft;
      context.fillText(shortNumber(value), isRight ? x + 5 : x - 5, y);
    }
    if (!scale.unit) return;
    // Axes of several units are distinguished by the colour of their curve, if it is the only one.
    const own = this.lines.filter((one) => one.unit === scale.unit);
    context.fillStyle = own.length === 1 && this.scales.length > 1 ? own[0]!.color : soft;
    context.save();
    context.translate(isRight ? x + AXIS_PX - 4 : x - AXIS_PX + 2, top + height / 2);
    context.rotate(-Math.PI / 2);
    context.textAlign = 'center';
    context.textBaseline = isRight ? 'bottom' : 'top';
    context.fillText(scale.unit, 0, 0);
    context.restore();
  }

  private drawLine(context: CanvasRenderingContext2D, line: Line): void {
    const scale = this.scales.find(({ unit }) => unit === line.unit)!;
    const points = pointsOnScreen(line.samples, this.span, this.toX, (value) =>
      this.toY(scale, value),
    );
    context.strokeStyle = line.color;
    context.lineWidth = 1.5;
    context.lineJoin = 'round';
    context.beginPath();
    let isDown = false;
    for (const point of points) {
      if (!point) isDown = false;
      else {
        if (isDown) context.lineTo(point[0], point[1]);
        else context.moveTo(point[0], point[1]);
        isDown = true;
      }
    }
    context.stroke();
  }

  private drawDots(context: CanvasRenderingContext2D, timeS: number): void {
    for (const { samples, unit, color } of this.lines) {
      const i = indexAt(samples.times, timeS);
      const value = samples.values[i];
      if (value === undefined || !Number.isFinite(value)) continue;
      const scale = this.scales.find((one) => one.unit === unit)!;
      context.fillStyle = color;
      context.beginPath();
      context.arc(this.toX(samples.times[i]!), this.toY(scale, value), 3.5, 0, 2 * Math.PI);
      context.fill();
    }
  }

  private listen(): void {
    const { canvas } = this;
    const { signal } = this.leave;
    const leftOf = (event: { clientX: number }) =>
      event.clientX - canvas.getBoundingClientRect().left;
    let panFrom: { x: number; span: Span } | undefined;
    let downX = 0;
    const fingers = new Map<number, number>();
    canvas.addEventListener(
      'wheel',
      (event) => {
        event.preventDefault();
        this.zoom(event.deltaY > 0 ? WHEEL_FACTOR : 1 / WHEEL_FACTOR, leftOf(event));
      },
      { signal, passive: false },
    );
    canvas.addEventListener(
      'pointerdown',
      (event) => {
        downX = leftOf(event);
        canvas.setPointerCapture(event.pointerId);
        if (event.pointerType === 'touch') {
          fingers.set(event.pointerId, downX);
          return;
        }
        if (event.button === 1 || event.shiftKey) panFrom = { x: downX, span: { ...this.span } };
        else if (event.button === 0) this.selection = [downX, downX];
        if (event.button === 1) event.preventDefault();
      },
      { signal },
    );
    canvas.addEventListener(
      'pointermove',
      (event) => {
        const x = leftOf(event);
        const before = fingers.get(event.pointerId);
        if (before !== undefined) {
          fingers.set(event.pointerId, x);
          const other = [...fingers].find(([id]) => id !== event.pointerId)?.[1];
          if (other === undefined) this.pan(this.span, x - before);
          else if (Math.abs(before - other) > 5 && Math.abs(x - other) > 5) {
            this.zoom(Math.abs(before - other) / Math.abs(x - other), (x + other) / 2);
          }
          return;
        }
        if (panFrom) this.pan(panFrom.span, x - panFrom.x);
        else if (this.selection) {
          this.selection = [this.selection[0], x];
          this.draw();
        }
        this.events.cursor(this.inside(x));
      },
      { signal },
    );
    const end = (event: PointerEvent) => {
      const x = leftOf(event);
      const isClick = Math.abs(x - downX) <= CLICK_PX && fingers.size < 2;
      fingers.delete(event.pointerId);
      const { selection } = this;
      const wasPan = panFrom !== undefined;
      panFrom = this.selection = undefined;
      if (event.type !== 'pointerup') return;
      const timeS = this.inside(x);
      if (isClick) {
        if (!wasPan && timeS !== undefined) this.events.click(timeS);
        this.events.cursor(timeS);
      } else if (selection) {
        const [a, b] = [this.toTime(selection[0]), this.toTime(x)].sort((p, q) => p - q);
        if (b! - a! > MIN_SPAN_S) this.events.span({ fromS: a!, toS: b! });
      }
    };
    canvas.addEventListener('pointerup', end, { signal });
    canvas.addEventListener('pointercancel', end, { signal });
    canvas.addEventListener('pointerleave', () => this.events.cursor(undefined), { signal });
    canvas.addEventListener('dblclick', () => this.events.span(undefined), { signal });
  }

  /** Time at a position, if it is inside the axes. */
  private inside(x: number): number | undefined {
    const { left, width } = this.area;
    return x >= left && x <= left + width ? this.toTime(x) : undefined;
  }

  private pan({ fromS, toS }: Span, px: number): void {
    const byS = (-px / this.area.width) * (toS - fromS);
    if (byS !== 0) this.events.span({ fromS: fromS + byS, toS: toS + byS });
  }

  /** Zooms around a position in the chart, or around its middle. */
  zoom(factor: number, x?: number): void {
    const { fromS, toS } = this.span;
    const at = x === undefined ? (fromS + toS) / 2 : this.toTime(x);
    const span = { fromS: at - (at - fromS) * factor, toS: at + (toS - at) * factor };
    if (span.toS - span.fromS > MIN_SPAN_S) this.events.span(span);
  }

  stop(): void {
    this.observer.disconnect();
    this.leave.abort();
    this.canvas.remove();
  }
}

function vertical(
  context: CanvasRenderingContext2D,
  x: number,
  top: number,
  height: number,
  color: string,
  width: number,
  dash: number[] = [],
): void {
  context.strokeStyle = color;
  context.lineWidth = width;
  context.setLineDash(dash);
  context.beginPath();
  context.moveTo(x, top);
  context.lineTo(x, top + height);
  context.stroke();
  context.setLineDash([]);
}
