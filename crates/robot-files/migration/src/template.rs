//! Values that may be expressions of xacro: `0.1`, `${radius * 2}`, `$(arg rate)`.

/// True if a value contains an expression or substitution of xacro.
pub(crate) fn is_template(text: &str) -> bool {
    text.contains("${") || text.contains("$(")
}

/// The value as a number; `None` for templates and other text.
pub(crate) fn number(text: &str) -> Option<f64> {
    text.trim().parse::<f64>().ok().filter(|number| number.is_finite())
}

/// The expression of a value that is one `${...}`, or the number itself.
fn expression(text: &str) -> Option<String> {
    let text = text.trim();
    if number(text).is_some() {
        return Some(text.to_owned());
    }
    let inner = text.strip_prefix("${")?.strip_suffix('}')?;
    (!inner.contains(['{', '}'])).then(|| inner.trim().to_owned())
}

/// Half of a value. `${2 * radius}` and `${radius * 2}` give `${radius}`, other expressions `${(...) / 2}`. `None` for
/// text with several substitutions.
pub(crate) fn half(text: &str) -> Option<String> {
    if let Some(number) = number(text) {
        return Some(shown(number / 2.0));
    }
    let inner = expression(text)?;
    let factor = |part: &str| matches!(part.trim(), "2" | "2.0");
    if let Some((a, b)) = inner.split_once('*')
        && is_name(a.trim()) | is_name(b.trim())
    {
        let rest = match (factor(a), factor(b)) {
            (true, _) => Some(b),
            (_, true) => Some(a),
            _ => None,
        };
        if let Some(rest) = rest.map(str::trim).filter(|rest| is_name(rest)) {
            return Some(format!("${{{rest}}}"));
        }
    }
    Some(if is_name(&inner) { format!("${{{inner} / 2}}") } else { format!("${{({inner}) / 2}}") })
}

/// Twice the quotient of two values, `2 a / b`.
pub(crate) fn twice_quotient(a: &str, b: &str) -> Option<String> {
    if let (Some(a), Some(b)) = (number(a), number(b)) {
        return (b != 0.0).then(|| shown(2.0 * a / b));
    }
    let (a, b) = (expression(a)?, expression(b)?);
    Some(format!("${{2.0 * ({a}) / ({b})}}"))
}

/// The negative of a value.
pub(crate) fn negative(text: &str) -> Option<String> {
    if let Some(number) = number(text) {
        return Some(shown(-number));
    }
    Some(format!("${{-({})}}", expression(text)?))
}

fn is_name(text: &str) -> bool {
    !text.is_empty() && text.chars().all(|c| c.is_alphanumeric() || c == '_' || c == '.')
}

/// Shortest decimal that reads back as the same number.
pub(crate) fn shown(number: f64) -> String {
    let text = format!("{number}");
    if text == "-0" { "0".to_owned() } else { text }
}

/// Value of a flag as Gazebo reads it; `None` for templates.
pub(crate) fn flag(text: &str) -> Option<bool> {
    match text.trim().to_ascii_lowercase().as_str() {
        "true" | "1" => Some(true),
        "false" | "0" => Some(false),
        _ => None,
    }
}

/// Topic without a doubled slash. A template at the start stays relative, since its value may begin with a slash.
pub(crate) fn topic(name: &str) -> String {
    let mut name = name.to_owned();
    while name.contains("//") {
        name = name.replace("//", "/");
    }
    if name.starts_with("/$") { name[1..].to_owned() } else { name }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_of_numbers_and_expressions() {
        assert_eq!(half("0.3").unwrap(), "0.15");
        assert_eq!(half("${wheel_radius * 2}").unwrap(), "${wheel_radius}");
        assert_eq!(half("${2*r}").unwrap(), "${r}");
        assert_eq!(half("${diameter}").unwrap(), "${diameter / 2}");
        assert_eq!(half("${a + b}").unwrap(), "${(a + b) / 2}");
        assert_eq!(half("${2 * r + 1}").unwrap(), "${(2 * r + 1) / 2}");
        assert_eq!(half("$(arg diameter)"), None);
    }

    #[test]
    fn quotients_and_negatives() {
        assert_eq!(twice_quotient("1", "0.5").unwrap(), "4");
        assert_eq!(twice_quotient("1", "${w}").unwrap(), "${2.0 * (1) / (w)}");
        assert_eq!(negative("1.5").unwrap(), "-1.5");
        assert_eq!(negative("0").unwrap(), "0");
        assert_eq!(negative("${a}").unwrap(), "${-(a)}");
    }

    #[test]
    fn topics_with_templates_stay_relative() {
        assert_eq!(topic("/scan"), "/scan");
        assert_eq!(topic("/${ns}/scan"), "${ns}/scan");
        assert_eq!(topic("//scan"), "/scan");
    }
}
