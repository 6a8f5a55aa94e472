//! Surface normals of points of a scan.

/// Maximum gap between points of one surface \[m\].
const MAX_GAP_M: f32 = 0.6;
/// Maximum gap at glancing incidence, as a multiple of that at normal incidence.
const GLANCING_FACTOR: f32 = 6.0;
/// Maximum gap that never separates surfaces \[m\].
const MIN_GAP_M: f32 = 0.12;
/// Extent of the neighbourhood along the scan on either side \[m\], and its minimum and maximum
/// number of points.
const REACH_M: f32 = 0.25;
const MIN_POINTS: usize = 2;
const MAX_POINTS: usize = 10;
/// Maximum root mean square distance of the points from their line \[m\],
const MAX_RMS_M: f32 = 0.035;
/// and minimum ratio of its length to its width.
const MIN_ASPECT_RATIO: f32 = 4.0;

/// Point of a scan with its index.
#[derive(Clone, Copy)]
pub(crate) struct Beam {
    pub(crate) x: f32,
    pub(crate) y: f32,
    /// Index in the scan, counting beams without a return.
    pub(crate) index: usize,
}

/// Normal of the line through a point and its neighbours along the scan, towards the scanner; (0,
/// 0) where there is no line. Total least squares.
pub(crate) fn normal(beams: &[Beam], at: usize, origin: [f32; 2], step_rad: f32) -> [f32; 2] {
    let here = beams[at];
    let is_joined = |a: Beam, b: Beam| {
        let range = libm::hypotf(b.x - origin[0], b.y - origin[1]);
        let gap = (GLANCING_FACTOR * range * step_rad).clamp(MIN_GAP_M, MAX_GAP_M);
        a.index.abs_diff(b.index) <= 2 && square(a.x - b.x) + square(a.y - b.y) < square(gap)
    };
    let mut sums = Sums::default();
    sums.add(0.0, 0.0);
    for forward in [false, true] {
        let mut last = here;
        for count in 1..=MAX_POINTS {
            let next = if forward { at.checked_add(count) } else { at.checked_sub(count) };
            let Some(&next) = next.and_then(|index| beams.get(index)) else { break };
            let (x, y) = (next.x - here.x, next.y - here.y);
            if !is_joined(last, next)
                || (count > MIN_POINTS && square(x) + square(y) > square(REACH_M))
            {
                break;
            }
            sums.add(x, y);
            last = next;
        }
    }
    sums.normal(origin[0] - here.x, origin[1] - here.y)
}

fn square(value: f32) -> f32 {
    value * value
}

#[derive(Default)]
struct Sums {
    count: f32,
    x: f32,
    y: f32,
    xx: f32,
    xy: f32,
    yy: f32,
}

impl Sums {
    fn add(&mut self, x: f32, y: f32) {
        self.count += 1.0;
        self.x += x;
        self.y += y;
        self.xx += x * x;
        self.xy += x * y;
        self.yy += y * y;
    }

    fn normal(&self, to_scanner_x: f32, to_scanner_y: f32) -> [f32; 2] {
        if self.count < 3.0 {
            return [0.0; 2];
        }
        let (mean_x, mean_y) = (self.x / self.count, self.y / self.count);
        let xx = self.xx / self.count - mean_x * mean_x;
        let xy = self.xy / self.count - mean_x * mean_y;
        let yy = self.yy / self.count - mean_y * mean_y;
        let (mean, half) = (0.5 * (xx + yy), 0.5 * (xx - yy));
        let spread = (half * half + xy * xy).sqrt();
        let (across, along) = ((mean - spread).max(0.0), mean + spread);
        if across > MAX_RMS_M * MAX_RMS_M || across * MIN_ASPECT_RATIO * MIN_ASPECT_RATIO > along {
            return [0.0; 2];
        }
        let (a, b) = ((xx - across, xy), (xy, yy - across));
        let (u, v) = if a.0.abs() + a.1.abs() > b.0.abs() + b.1.abs() { a } else { b };
        let length = (u * u + v * v).sqrt();
        if length == 0.0 {
            return [0.0; 2];
        }
        let (x, y) = (-v / length, u / length);
        if x * to_scanner_x + y * to_scanner_y >= 0.0 { [x, y] } else { [-x, -y] }
    }
}
