/** Conversion between RViz's views and those of the page. */
import type { ViewState } from '../scene/view';
import type { RvizView } from './file';

type Out = Partial<ViewState>;

export function viewFrom(view: RvizView): Out {
  const name = view.class.split('/').pop() ?? '';
  const number = (path: string, otherwise: number) => {
    const value = Number(view.values[path]);
    return Number.isFinite(value) && view.values[path] !== undefined ? value : otherwise;
  };
  const targetFrame = String(view.values['Target Frame'] ?? '<Fixed Frame>');
  if (name === 'TopDownOrtho') {
    return {
      kind: 'TopDownOrtho',
      scale: Math.abs(number('Scale', 60)),
      angle: -number('Angle', 0),
      x: number('X', 0),
      y: number('Y', 0),
      targetFrame,
    };
  }
  return {
    // Other views (XYOrbit, FPS) become an Orbit view from the same camera pose.
    kind: name === 'ThirdPersonFollower' ? 'ThirdPersonFollower' : 'Orbit',
    distance: number('Distance', 10),
    focal: ['X', 'Y', 'Z'].map((axis) => number(`Focal Point/${axis}`, 0)) as ViewState['focal'],
    pitch: number('Pitch', 0.785),
    yaw: number('Yaw', 0.785),
    targetFrame,
  };
}

export function viewTo(state: ViewState): RvizView {
  const shared = { Name: 'Current View', 'Target Frame': state.targetFrame, Value: state.kind };
  if (state.kind === 'TopDownOrtho') {
    const { angle, scale, x: X, y: Y } = state;
    const values = { ...shared, Angle: -angle, Scale: scale, X, Y, Value: 'TopDownOrtho (rviz)' };
    return { class: 'rviz_default_plugins/TopDownOrtho', values };
  }
  const [x, y, z] = state.focal;
  return {
    class: `rviz_default_plugins/${state.kind}`,
    values: {
      ...shared,
      Distance: state.distance,
      'Focal Point/X': x,
      'Focal Point/Y': y,
      'Focal Point/Z': z,
      Pitch: state.pitch,
      Yaw: ((state.yaw % (2 * Math.PI)) + 2 * Math.PI) % (2 * Math.PI),
      'Near Clip Distance': 0.01,
      Value: `${state.kind} (rviz)`,
    },
  };
}
