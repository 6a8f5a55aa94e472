/** Times of a recording as text, and ticks of the timeline. */

const pad = (value: number, digits = 2) => String(value).padStart(digits, '0');

/** Offset from the start: `0:12.345`, `1:02:03.000`. */
export function offsetText(ns: number, decimals = 3): string {
  const sign = ns < 0 ? '−' : '';
  const unit = 10 ** decimals;
  const all = Math.round((Math.abs(ns) / 1e9) * unit);
  const [whole, part] = [Math.floor(all / unit), all % unit];
  const [h, m, s] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60, whole % 60];
  const head = h > 0 ? `${h}:${pad(m)}` : String(m);
  return `${sign}${head}:${pad(s)}${decimals > 0 ? `.${pad(part, decimals)}` : ''}`;
}

/** Log times before this are those of a simulation, which begins at 0 [s]. */
const MIN_DATE_S = 1e8;

/** Local date and time; empty for the time of a simulation. */
export function dateText(timeS: number): string {
  if (timeS < MIN_DATE_S) return '';
  const d = new Date(timeS * 1000);
  const day = `${d.getFullYear()}-${pad(d.getMonth() + 1)}-${pad(d.getDate())}`;
  return `${day} ${pad(d.getHours())}:${pad(d.getMinutes())}:${pad(d.getSeconds())}`;
}

export interface TimeView {
  fromNs: number;
  toNs: number;
}

const STEPS_S = [
  0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900,
  1800, 3600, 7200, 14400, 43200, 86400,
];

/** Ticks at round offsets, at most `count`. */
export function ticks(view: TimeView, count: number): { atNs: number; text: string }[] {
  const spanS = (view.toNs - view.fromNs) * 1e-9;
  const stepS = STEPS_S.find((step) => spanS / step <= count) ?? spanS;
  if (!(stepS > 0)) return [];
  const decimals = stepS >= 1 ? 0 : Math.ceil(-Math.log10(stepS) - 1e-9);
  const out = [];
  const first = Math.ceil((view.fromNs * 1e-9) / stepS - 1e-9);
  for (let i = first; i * stepS <= view.toNs * 1e-9 + 1e-9; i++) {
    const atNs = i * stepS * 1e9;
    out.push({ atNs, text: offsetText(atNs, decimals) });
  }
  return out;
}

/** Shortest span that is shown [ns]. */
const MIN_SPAN_NS = 1e6;

/** View after zooming by a factor about a position; within the bounds. */
export function zoomed(
  view: TimeView,
  factor: number,
  aboutNs: number,
  bounds: TimeView,
): TimeView {
  const whole = bounds.toNs - bounds.fromNs;
  const span = Math.min(whole, Math.max(MIN_SPAN_NS, (view.toNs - view.fromNs) * factor));
  const part = (aboutNs - view.fromNs) / Math.max(1, view.toNs - view.fromNs);
  return panned({ fromNs: aboutNs - part * span, toNs: aboutNs + (1 - part) * span }, 0, bounds);
}

/** View moved by a distance; within the bounds. */
export function panned(view: TimeView, byNs: number, bounds: TimeView): TimeView {
  const span = view.toNs - view.fromNs;
  const fromNs = Math.min(Math.max(view.fromNs + byNs, bounds.fromNs), bounds.toNs - span);
  return { fromNs, toNs: fromNs + span };
}

/** Neighbours closer than a distance, as one group each. */
export function clustered<T extends { positionNs: number }>(
  sorted: readonly T[],
  distanceNs: number,
): T[][] {
  const out: T[][] = [];
  for (const one of sorted) {
    const last = out[out.length - 1];
    if (last && one.positionNs - last[0]!.positionNs < distanceNs) last.push(one);
    else out.push([one]);
  }
  return out;
}
