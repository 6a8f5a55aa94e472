/** Chart of curves over time: one y axis per unit, zoom, pan, a cursor shared by the charts of a panel. */
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import type { Samples } from './expression';
import { aligned } from './statistics';

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

const HEIGHT_PX = 220;
const WHEEL_FACTOR = 1.2;
const CLICK_PX = 4;
/** Larger times are shown from their first second, because digits of a date hide those that differ. */
const LONG_TIME_S = 1e6;

export class TimeChart {
  private chart?: uPlot;
  private key = '';
  private span: Span = { fromS: 0, toS: 1 };
  private markS?: number;
  private offsetS = 0;
  private observer: ResizeObserver;
  private pointers = new Map<number, number>();
  private leave = new AbortController();

  constructor(
    private holder: HTMLElement,
    private syncKey: string,
    private events: ChartEvents,
    private style: () => ChartStyle,
    private timeLabel: (offsetS: number) => string,
  ) {
    this.observer = new ResizeObserver(() => {
      if (holder.clientWidth > 0) {
        this.chart?.setSize({ width: holder.clientWidth, height: HEIGHT_PX });
      }
    });
    this.observer.observe(holder);
  }

  /** Shows curves; rebuilds the chart only when their names, units or colours change. */
  update(lines: readonly Line[], span: Span, markS: number | undefined, theme: string): void {
    const offsetS = span.toS > LONG_TIME_S ? this.chosenOffset(span) : 0;
    const key = JSON.stringify([theme, offsetS, lines.map((l) => [l.label, l.unit, l.color])]);
    this.span = span;
    this.markS = markS;
    if (key !== this.key) {
      this.key = key;
      this.offsetS = offsetS;
      this.build(lines);
    }
    if (!this.chart) return;
    const { times, columns } = aligned(
      lines.map((line) => line.samples),
      span.fromS,
      span.toS,
    );
    this.chart.setData([times, ...columns] as uPlot.AlignedData);
  }

  /** Offset of the labels: kept while it is near, since a new one rebuilds the chart. */
  private chosenOffset({ fromS }: Span): number {
    const isNear = this.offsetS > 0 && Math.abs(fromS - this.offsetS) < 3600;
    return isNear ? this.offsetS : Math.floor(fromS);
  }

  private build(lines: readonly Line[]): void {
    this.chart?.destroy();
    this.chart = undefined;
    if (lines.length === 0 || this.holder.clientWidth === 0) {
      if (lines.length > 0) this.key = '';
      return;
    }
    const { soft, line, accent } = this.style();
    const axis = {
      stroke: soft,
      grid: { stroke: line, width: 1 },
      ticks: { stroke: line },
      font: '11px system-ui',
      labelFont: '11px system-ui',
      labelSize: 16,
    };
    const units = [...new Set(lines.map((one) => one.unit))];
    const scales: uPlot.Scales = {
      x: { time: false, range: () => [this.span.fromS, this.span.toS] },
    };
    for (const unit of units) scales[scaleOf(unit)] = { auto: true };
    this.chart = new uPlot(
      {
        width: this.holder.clientWidth,
        height: HEIGHT_PX,
        scales,
        axes: [
          {
            ...axis,
            size: 28,
            label: this.timeLabel(this.offsetS),
            values: (_u, splits) => splits.map((v) => shortNumber(v - this.offsetS)),
          },
          ...units.map((unit, i) => ({
            ...axis,
            scale: scaleOf(unit),
            label: unit || undefined,
            side: (i % 2 === 0 ? 3 : 1) as 1 | 3,
            size: 54,
            grid: i === 0 ? axis.grid : { show: false },
            values: (_u: uPlot, splits: number[]) => splits.map(shortNumber),
          })),
        ],
        legend: { show: false },
        cursor: {
          drag: { x: true, y: false, setScale: false },
          sync: { key: this.syncKey, scales: ['x', null] },
          points: { size: 7 },
        },
        series: [
          { label: 'time' },
          ...lines.map((one) => ({
            label: one.label,
            scale: scaleOf(one.unit),
            stroke: one.color,
            width: 1.5,
            spanGaps: true,
            points: { show: false },
          })),
        ],
        hooks: {
          setSelect: [(u) => this.selected(u)],
          setCursor: [
            (u) => {
              const { left } = u.cursor;
              const isInside = left !== undefined && left !== null && left >= 0;
              this.events.cursor(isInside ? u.posToVal(left, 'x') : undefined);
            },
          ],
          draw: [(u) => this.drawMark(u, accent)],
        },
      },
      [[], ...lines.map(() => [])] as never,
      this.holder,
    );
    this.listen(this.chart.over);
  }

  private selected(u: uPlot): void {
    if (u.select.width <= CLICK_PX) return;
    this.events.span({
      fromS: u.posToVal(u.select.left, 'x'),
      toS: u.posToVal(u.select.left + u.select.width, 'x'),
    });
    u.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
  }

  private drawMark(u: uPlot, color: string): void {
    const { markS, span } = this;
    if (markS === undefined || markS < span.fromS || markS > span.toS) return;
    const x = Math.round(u.valToPos(markS, 'x', true));
    const { ctx, bbox } = u;
    ctx.save();
    ctx.strokeStyle = color;
    ctx.lineWidth = 2;
    ctx.beginPath();
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    ctx.stroke();
    ctx.restore();
  }

  private listen(over: HTMLElement): void {
    this.leave.abort();
    this.leave = new AbortController();
    const { signal } = this.leave;
    let downX = 0;
    let panFrom: Span | undefined;
    over.style.touchAction = 'pan-y';
    over.addEventListener(
      'wheel',
      (event) => {
        event.preventDefault();
        const factor = event.deltaY > 0 ? WHEEL_FACTOR : 1 / WHEEL_FACTOR;
        this.zoom(factor, event.clientX - over.getBoundingClientRect().left);
      },
      { signal, passive: false },
    );
    // Capture: a pan with the middle button or Shift must not begin a selection.
    over.addEventListener(
      'mousedown',
      (event) => {
        downX = event.clientX;
        if (event.button !== 1 && !event.shiftKey) return;
        event.preventDefault();
        event.stopImmediatePropagation();
        panFrom = { ...this.span };
      },
      { signal, capture: true },
    );
    window.addEventListener(
      'mousemove',
      (event) => {
        if (panFrom) this.panBy(panFrom, event.clientX - downX);
      },
      { signal },
    );
    window.addEventListener('mouseup', () => (panFrom = undefined), { signal });
    over.addEventListener(
      'click',
      (event) => {
        if (Math.abs(event.clientX - downX) > CLICK_PX || event.shiftKey || !this.chart) return;
        const left = event.clientX - over.getBoundingClientRect().left;
        this.events.click(this.chart.posToVal(left, 'x'));
      },
      { signal },
    );
    over.addEventListener('dblclick', () => this.events.span(undefined), { signal });
    this.listenTouch(over, signal);
  }

  /** One finger pans, two fingers zoom. */
  private listenTouch(over: HTMLElement, signal: AbortSignal): void {
    over.addEventListener(
      'pointerdown',
      (event) => {
        if (event.pointerType === 'touch') this.pointers.set(event.pointerId, event.clientX);
      },
      { signal },
    );
    over.addEventListener(
      'pointermove',
      (event) => {
        const before = this.pointers.get(event.pointerId);
        if (before === undefined) return;
        this.pointers.set(event.pointerId, event.clientX);
        const other = [...this.pointers].find(([id]) => id !== event.pointerId)?.[1];
        if (other === undefined) this.panBy(this.span, event.clientX - before);
        else {
          const [was, is] = [Math.abs(before - other), Math.abs(event.clientX - other)];
          const middle = (event.clientX + other) / 2 - over.getBoundingClientRect().left;
          if (was > 5 && is > 5) this.zoom(was / is, middle);
        }
      },
      { signal },
    );
    for (const end of ['pointerup', 'pointercancel', 'pointerleave'] as const) {
      over.addEventListener(end, (event) => this.pointers.delete(event.pointerId), { signal });
    }
  }

  private panBy({ fromS, toS }: Span, px: number): void {
    const width = this.chart?.over.clientWidth;
    if (!width) return;
    const byS = (-px / width) * (toS - fromS);
    if (byS !== 0) this.events.span({ fromS: fromS + byS, toS: toS + byS });
  }

  /** Zooms around a position in the chart, or around its middle. */
  zoom(factor: number, left?: number): void {
    const { fromS, toS } = this.span;
    const at =
      left === undefined || !this.chart ? (fromS + toS) / 2 : this.chart.posToVal(left, 'x');
    const span = { fromS: at - (at - fromS) * factor, toS: at + (toS - at) * factor };
    if (span.toS - span.fromS > 1e-5) this.events.span(span);
  }

  /** Image of the chart; `undefined` while it is empty. */
  get canvas(): HTMLCanvasElement | undefined {
    return this.chart?.ctx.canvas;
  }

  stop(): void {
    this.observer.disconnect();
    this.leave.abort();
    this.chart?.destroy();
  }
}

const scaleOf = (unit: string): string => `y ${unit}`;

/** Number of a tick: without trailing digits of rounding. */
export function shortNumber(value: number): string {
  if (value !== 0 && (Math.abs(value) >= 1e6 || Math.abs(value) < 1e-4)) {
    return value.toExponential(1);
  }
  return String(Number(value.toPrecision(7)));
}
