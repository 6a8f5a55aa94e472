/** FluidPressure, Illuminance, RelativeHumidity, Temperature: a measured value as a coloured point. */
import { t } from '../texts/language.svelte';
import type { Header } from '../core/types';
import type { Rows } from '../scene/cloud';
import { cloudOptions } from './cloud_appearance';
import { PointsDisplay } from './clouds';
import type { Kind } from './display';
import { bool, number, topic, type Option } from './options';

interface Scalar {
  name: string;
  /** Field of the message. */
  field: string;
  min: number;
  max: number;
  isInverted?: boolean;
  help: () => string;
}

class ScalarDisplay extends PointsDisplay<{ header: Header }> {
  constructor(
    private field: string,
    ...all: Parameters<Kind['make']>
  ) {
    super(...all);
  }

  /** One point at the origin of the sensor's frame. */
  protected override rows(message: { header: Header }): Rows {
    const value = Number((message as never as Record<string, number>)[this.field]);
    this.host.status('Value', Number.isFinite(value) ? 'ok' : 'warn', String(value));
    const row = new Float32Array([0, 0, 0, value]);
    const count = Number.isFinite(value) ? 1 : 0;
    return { words: new Uint32Array(row.buffer), stride: 4, count, xyz: 0, value: 3, isOwn: true };
  }
}

function optionsOf({ field, min, max, isInverted }: Scalar): Option[] {
  // RViz hides what does not apply to a single value, but writes it to files.
  const hidden = { when: () => false };
  return cloudOptions('Intensity').map((option): Option => {
    switch (option.path) {
      case 'Channel Name':
        return { ...option, default: field, ...hidden };
      case 'Autocompute Intensity Bounds':
        return bool(option.path, false, hidden);
      case 'Invert Rainbow':
        return { ...option, default: isInverted ?? false };
      case 'Min Intensity':
        return number(option.path, min);
      case 'Max Intensity':
        return number(option.path, max);
      case 'Position Transformer':
      case 'Color Transformer':
        return { ...option, ...hidden };
      default:
        return option;
    }
  });
}

function kind(scalar: Scalar): Kind {
  const types = [`sensor_msgs/msg/${scalar.name}`];
  return {
    class: `rviz_default_plugins/${scalar.name}`,
    also: [`rviz/${scalar.name}`],
    title: scalar.name,
    get help() {
      return scalar.help();
    },
    types,
    options: [...topic('Topic', '', types, { isFiltered: true }), ...optionsOf(scalar)],
    make: (...all) => new ScalarDisplay(scalar.field, ...all),
  };
}

export const fluidPressure = kind({
  name: 'FluidPressure',
  field: 'fluid_pressure',
  min: 98_000,
  max: 105_000,
  help: () => t().valueDisplays.fluidPressure,
});
export const illuminance = kind({
  name: 'Illuminance',
  field: 'illuminance',
  min: 0,
  max: 1000,
  help: () => t().valueDisplays.illuminance,
});
export const relativeHumidity = kind({
  name: 'RelativeHumidity',
  field: 'relative_humidity',
  min: 0,
  max: 1,
  help: () => t().valueDisplays.relativeHumidity,
});
export const temperature = kind({
  name: 'Temperature',
  field: 'temperature',
  min: 0,
  max: 100,
  isInverted: true,
  help: () => t().valueDisplays.temperature,
});
