//! Drawing of a tree as shapes, independent of the file format. Lengths are in points, y points
//! down.

use periplus_tf::TransformKind;

use crate::frames::forest::{Forest, Frame};
use crate::frames::layout::{Layout, layout};
use crate::frames::widths::width;

/// Red, green, blue.
pub(crate) type Colour = [u8; 3];

const TEXT_COLOUR: Colour = [0x1f, 0x29, 0x37];
const NOTE_COLOUR: Colour = [0x6b, 0x72, 0x80];
const STATIC_COLOUR: Colour = [0x94, 0xa3, 0xb8];
const DYNAMIC_COLOUR: Colour = [0x25, 0x63, 0xeb];
const DYNAMIC_FILL: Colour = [0xef, 0xf5, 0xff];
const STATIC_FILL: Colour = [0xf5, 0xf6, 0xf8];
const ROOT_FILL: Colour = [0xe7, 0xf6, 0xec];
const ROOT_COLOUR: Colour = [0x15, 0x80, 0x3d];
const FAULT_COLOUR: Colour = [0xdc, 0x26, 0x26];
const PAGE_COLOUR: Colour = [0xff, 0xff, 0xff];

/// Margin of the page.
const MARGIN_PT: f64 = 28.0;
const NAME_SIZE_PT: f64 = 12.0;
const NAME_HEIGHT_PT: f64 = 28.0;
const LABEL_SIZE_PT: f64 = 8.5;
const LABEL_LINE_PT: f64 = 11.5;
const LABEL_PAD_PT: f64 = 7.0;
/// Vertical distance from a frame to the label of its child, for a curve.
const CURVE_PT: f64 = 40.0;
/// Vertical distance from the label to the frame, for the arrow.
const ARROW_PT: f64 = 18.0;

/// Shape.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Shape {
    /// Rectangle with round corners.
    Card { at: [f64; 2], size: [f64; 2], round: f64, fill: Colour, stroke: Colour, is_dashed: bool },
    /// A Bézier curve.
    Curve { points: [[f64; 2]; 4], stroke: Colour, is_dashed: bool },
    /// Arrow head that points down to this point.
    Head { tip: [f64; 2], fill: Colour },
    /// Line of text on this base line, starting or centred at this point.
    Text { at: [f64; 2], text: String, size: f64, is_bold: bool, is_centred: bool, fill: Colour },
}

/// Shapes on a page of this size.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Drawing {
    pub(crate) size: [f64; 2],
    pub(crate) shapes: Vec<Shape>,
}

impl Drawing {
    /// Drawing of a tree that was recorded at this time \[s\].
    pub(crate) fn of(forest: &Forest, recorded_at: &str) -> Self {
        let widths: Vec<f64> = forest.frames.iter().map(breadth).collect();
        let layout = layout(forest, &widths);
        let mut drawing = Self { size: [0.0, 0.0], shapes: Vec::new() };
        let (head_width, head_height) = drawing.head(forest, recorded_at);
        let width = layout.width.max(head_width) + 2.0 * MARGIN_PT;
        let place = Positions {
            forest,
            left: 0.5 * (width - layout.width),
            top: head_height,
            label_height: 5.0 * LABEL_LINE_PT + 2.0 * LABEL_PAD_PT,
            layout,
        };
        // Lines first, so that cards cover them.
        for &frame in &forest.downward() {
            drawing.lines(&place, frame);
        }
        for &frame in &forest.downward() {
            drawing.cards(&place, frame);
        }
        drawing.size = [
            width,
            place.frame_top(place.layout.layers.saturating_sub(1)) + NAME_HEIGHT_PT + MARGIN_PT,
        ];
        if forest.frames.is_empty() {
            drawing.size[1] = head_height + MARGIN_PT;
        }
        drawing
    }

    /// Adds title, legend and faults; returns their size.
    fn head(&mut self, forest: &Forest, recorded_at: &str) -> (f64, f64) {
        let (mut y, mut widest) = (MARGIN_PT + 16.0, 0.0_f64);
        let mut line = |shapes: &mut Vec<Shape>, text: String, size: f64, is_bold, fill| {
            widest = widest.max(width(&text, size, is_bold));
            shapes.push(Shape::Text {
                at: [MARGIN_PT, y],
                text,
                size,
                is_bold,
                is_centred: false,
                fill,
            });
            y += size + 6.0;
        };
        let shapes = &mut self.shapes;
        line(shapes, "view_frames Result".into(), 17.0, true, TEXT_COLOUR);
        line(shapes, format!("Recorded at time: {recorded_at}"), 10.0, false, NOTE_COLOUR);
        if forest.frames.is_empty() {
            line(shapes, "No tf data received".into(), 12.0, true, FAULT_COLOUR);
        } else {
            let roots = forest.roots().count();
            let counts = format!(
                "{} frames, {roots} root{}; blue: moving, grey and dashed: static",
                forest.frames.len(),
                if roots == 1 { "" } else { "s" }
            );
            line(shapes, counts, 10.0, false, NOTE_COLOUR);
        }
        for fault in forest.faults() {
            line(shapes, fault.to_string().replace('`', ""), 11.0, true, FAULT_COLOUR);
        }
        (widest, y + 10.0)
    }

    fn lines(&mut self, place: &Positions<'_>, frame: usize) {
        let from = place.bottom(frame);
        for child in place.forest.below(frame) {
            let to = place.label_top(child);
            let is_dashed = is_fixed(&place.forest.frames[child]);
            let middle = 0.5 * (from[1] + to[1]);
            self.shapes.push(Shape::Curve {
                points: [from, [from[0], middle], [to[0], middle], to],
                stroke: if is_dashed { STATIC_COLOUR } else { DYNAMIC_COLOUR },
                is_dashed,
            });
        }
        // Other edges: additional parents, and the edge that closes a loop.
        let it = &place.forest.frames[frame];
        let closing = it.edge.as_ref().filter(|_| place.forest.tops.contains(&frame));
        let elsewhere = it.other_parents.iter().chain(closing.map(|edge| &edge.parent));
        for parent in elsewhere {
            let found = place.forest.frames.binary_search_by(|frame| frame.name.cmp(parent));
            let Ok(parent) = found else { continue };
            let (from, to) = (place.bottom(parent), place.top(frame));
            let aside = if to[0] < from[0] { -1.0 } else { 1.0 } * (0.5 * breadth(it) + 24.0);
            self.shapes.push(Shape::Curve {
                points: [from, [from[0], from[1] + 60.0], [to[0] + aside, to[1] - 70.0], to],
                stroke: FAULT_COLOUR,
                is_dashed: true,
            });
            self.shapes.push(Shape::Head { tip: to, fill: FAULT_COLOUR });
        }
    }

    fn cards(&mut self, place: &Positions<'_>, frame: usize) {
        let it = &place.forest.frames[frame];
        let middle = place.middle(frame);
        let (is_fixed, is_root) = (is_fixed(it), it.edge.is_none());
        if let Some(edge) = &it.edge {
            let lines = edge.label();
            let size = [label_width(&lines), place.label_height];
            let [_, top] = place.label_top(frame);
            let (fill, stroke) = if is_fixed {
                (STATIC_FILL, STATIC_COLOUR)
            } else {
                (DYNAMIC_FILL, DYNAMIC_COLOUR)
            };
            self.shapes.push(Shape::Card {
                at: [middle - 0.5 * size[0], top],
                size,
                round: 5.0,
                fill,
                stroke: fill,
                is_dashed: false,
            });
            for (number, text) in (0_u8..).zip(lines) {
                let y = top + LABEL_PAD_PT + LABEL_LINE_PT * (f64::from(number) + 0.8);
                let at = [middle, y];
                let fill = NOTE_COLOUR;
                self.shapes.push(Shape::Text {
                    at,
                    text,
                    size: LABEL_SIZE_PT,
                    is_bold: false,
                    is_centred: true,
                    fill,
                });
            }
            let (from, to) = ([middle, top + size[1]], place.top(frame));
            let is_dashed = is_fixed;
            self.shapes.push(Shape::Curve { points: [from, from, to, to], stroke, is_dashed });
            self.shapes.push(Shape::Head { tip: to, fill: stroke });
        }
        let (fill, stroke) = match (is_root, is_fixed) {
            (true, _) => (ROOT_FILL, ROOT_COLOUR),
            (_, true) => (PAGE_COLOUR, STATIC_COLOUR),
            _ => (PAGE_COLOUR, DYNAMIC_COLOUR),
        };
        let size = [name_width(it), NAME_HEIGHT_PT];
        let top = place.top(frame);
        self.shapes.push(Shape::Card {
            at: [middle - 0.5 * size[0], top[1]],
            size,
            round: 0.5 * NAME_HEIGHT_PT,
            fill,
            stroke,
            is_dashed: is_fixed,
        });
        self.shapes.push(Shape::Text {
            at: [middle, top[1] + 0.5 * NAME_HEIGHT_PT + 0.36 * NAME_SIZE_PT],
            text: it.name.clone(),
            size: NAME_SIZE_PT,
            is_bold: true,
            is_centred: true,
            fill: TEXT_COLOUR,
        });
    }
}

/// Positions of frames on the page.
struct Positions<'a> {
    forest: &'a Forest,
    layout: Layout,
    left: f64,
    top: f64,
    label_height: f64,
}

impl Positions<'_> {
    fn middle(&self, frame: usize) -> f64 {
        self.left + self.layout.middle[frame]
    }

    /// Upper edge of the names of a layer.
    fn frame_top(&self, layer: usize) -> f64 {
        // A top frame with an edge (in a loop) has its label above.
        let is_closed = self.forest.tops.iter().any(|&top| self.forest.frames[top].edge.is_some());
        let first = if is_closed { self.label_height + ARROW_PT } else { 0.0 };
        let step = NAME_HEIGHT_PT + CURVE_PT + self.label_height + ARROW_PT;
        self.top + first + layer as f64 * step
    }

    fn top(&self, frame: usize) -> [f64; 2] {
        [self.middle(frame), self.frame_top(self.layout.layer[frame])]
    }

    fn bottom(&self, frame: usize) -> [f64; 2] {
        let [x, y] = self.top(frame);
        [x, y + NAME_HEIGHT_PT]
    }

    fn label_top(&self, frame: usize) -> [f64; 2] {
        let [x, y] = self.top(frame);
        [x, y - ARROW_PT - self.label_height]
    }
}

fn is_fixed(frame: &Frame) -> bool {
    frame.edge.as_ref().is_some_and(|edge| edge.kind == TransformKind::Fixed)
}

fn name_width(frame: &Frame) -> f64 {
    width(&frame.name, NAME_SIZE_PT, true) + 26.0
}

fn label_width(lines: &[String]) -> f64 {
    let widest = lines.iter().map(|line| width(line, LABEL_SIZE_PT, false)).fold(0.0, f64::max);
    widest + 2.0 * LABEL_PAD_PT
}

/// Width of a frame with its label.
fn breadth(frame: &Frame) -> f64 {
    let label = frame.edge.as_ref().map_or(0.0, |edge| label_width(&edge.label()));
    name_width(frame).max(label)
}
