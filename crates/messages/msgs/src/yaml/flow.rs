//! YAML in flow style: braces and brackets on one line.

use super::{Printer, quoted};
use crate::Number;
use crate::dynamic::{Element, Layout, Shape, Value};

pub(super) fn mapping(printer: &mut Printer<'_>, layout: &Layout, values: &[Value]) {
    printer.out.push('{');
    for (index, (field, value)) in layout.fields.iter().zip(values).enumerate() {
        separate(printer, index);
        printer.out.push_str(&quoted(&field.name));
        printer.out.push_str(": ");
        self::value(printer, &field.element, field.shape, value);
    }
    printer.out.push('}');
}

pub(super) fn value(printer: &mut Printer<'_>, element: &Element, shape: Shape, value: &Value) {
    match (value, shape) {
        (Value::Numbers(numbers), Shape::List(_)) => {
            let numbers = numbers.borrow();
            let one = |index| numbers.get(index).unwrap_or(Number::Bool(false));
            list(printer, numbers.len(), element, |printer, index| {
                scalar(printer, element, &Value::Number(one(index)));
            });
        }
        (Value::List(values), Shape::List(_)) => {
            list(printer, values.len(), element, |printer, index| {
                self::value(printer, element, Shape::One, &values[index]);
            });
        }
        (Value::Struct(values), _) => {
            if let Element::Struct(layout) = element {
                mapping(printer, layout, values);
            }
        }
        (value, _) => scalar(printer, element, value),
    }
}

fn list(
    printer: &mut Printer<'_>,
    length: usize,
    element: &Element,
    mut one: impl FnMut(&mut Printer<'_>, usize),
) {
    if let Some(text) = printer.stands_for(length, element) {
        printer.out.push_str(&text);
        return;
    }
    let shown = printer.style.longest.map_or(length, |longest| longest.min(length));
    printer.out.push('[');
    for index in 0..shown {
        separate(printer, index);
        one(printer, index);
    }
    if shown < length {
        separate(printer, shown);
        printer.out.push_str("'...'");
    }
    printer.out.push(']');
}

fn separate(printer: &mut Printer<'_>, index: usize) {
    if index > 0 {
        printer.out.push_str(", ");
    }
}

fn scalar(printer: &mut Printer<'_>, element: &Element, value: &Value) {
    let text = printer.scalar_text(value, element);
    // Inside brackets these characters end an unquoted text.
    let is_bare = !text.starts_with(['\'', '"']);
    if is_bare && text.contains([',', '[', ']', '{', '}', '?']) {
        printer.out.push_str(&format!("'{}'", text.replace('\'', "''")));
    } else {
        printer.out.push_str(&text);
    }
}
