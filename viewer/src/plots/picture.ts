/** Charts of a panel as one image. */

export interface Part {
  canvas: HTMLCanvasElement;
  legend: { text: string; color: string }[];
}

const LINE_PX = 18;
const PAD_PX = 10;

/** Charts below each other, each with its legend. */
export function picture(
  parts: readonly Part[],
  background: string,
  ink: string,
): HTMLCanvasElement {
  const ratio = window.devicePixelRatio || 1;
  const out = document.createElement('canvas');
  const heightOf = ({ canvas, legend }: Part) =>
    canvas.height + (legend.length * LINE_PX + PAD_PX) * ratio;
  out.width = Math.max(1, ...parts.map(({ canvas }) => canvas.width));
  out.height = Math.max(
    1,
    parts.map(heightOf).reduce((a, b) => a + b, 0),
  );
  const context = out.getContext('2d')!;
  context.fillStyle = background;
  context.fillRect(0, 0, out.width, out.height);
  context.font = `${12 * ratio}px system-ui`;
  context.textBaseline = 'middle';
  let top = 0;
  for (const part of parts) {
    context.drawImage(part.canvas, 0, top);
    part.legend.forEach(({ text, color }, i) => {
      const y = top + part.canvas.height + (i + 0.5) * LINE_PX * ratio;
      context.fillStyle = color;
      context.fillRect(PAD_PX * ratio, y - 1.5 * ratio, 14 * ratio, 3 * ratio);
      context.fillStyle = ink;
      context.fillText(text, (PAD_PX + 22) * ratio, y);
    });
    top += heightOf(part);
  }
  return out;
}
