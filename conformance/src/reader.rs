//! JSON reader whose errors name the position of the unexpected value.

use std::fmt;

use serde_json::Value;

use crate::used::Used;

/// Content of a case that its check does not understand.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unreadable(pub String);

impl fmt::Display for Unreadable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Unreadable {}

/// A value of a case and the path to it. Whatever is read from it is noted in [`Used`].
#[derive(Clone, Debug)]
pub struct CaseReader<'v> {
    value: &'v Value,
    used: &'v Used,
    path: String,
}

impl<'v> CaseReader<'v> {
    /// A value that is called so.
    #[must_use]
    pub fn new(value: &'v Value, used: &'v Used, name: &str) -> Self {
        Self { value, used, path: name.to_owned() }
    }

    fn part(&self, value: &'v Value, path: String) -> Self {
        Self { value, used: self.used, path }
    }

    /// The value with all that is within it, which all counts as used from now on.
    #[must_use]
    pub fn whole(&self) -> &'v Value {
        self.used.mark_all(self.value);
        self.value
    }

    /// Counts the value with all that is within it as used: it has no influence by nature.
    pub fn skip(&self) {
        self.used.mark_all(self.value);
    }

    /// The value for a look at its shape, without using it.
    pub(crate) fn raw(&self) -> &'v Value {
        self.value
    }

    /// The value as it is shown in messages, shortened.
    #[must_use]
    pub fn shown(&self) -> String {
        let mut shown = self.value.to_string();
        if shown.len() > 60 {
            let end = (0..=57).rev().find(|&end| shown.is_char_boundary(end)).unwrap_or(0);
            shown.truncate(end);
            shown += "...";
        }
        shown
    }

    /// The value as a user writes it in YAML.
    #[must_use]
    pub fn written(&self) -> String {
        match self.whole() {
            Value::String(text) => text.clone(),
            other => other.to_string(),
        }
    }

    /// The path to it.
    #[must_use]
    pub fn path(&self) -> &str {
        &self.path
    }

    /// Error that states the required type or value.
    #[must_use]
    pub fn unreadable(&self, wanted: &str) -> Unreadable {
        let shown = self.shown();
        Unreadable(format!("`{}` must be {wanted}; it is {shown}", self.path))
    }

    /// A member that must be there.
    ///
    /// # Errors
    /// When it is not.
    pub fn get(&self, name: &str) -> Result<Self, Unreadable> {
        self.find(name).ok_or_else(|| Unreadable(format!("`{}` has no `{name}`", self.path)))
    }

    /// A member, if it is there and not null. A null counts as used.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<Self> {
        let member = self.member(name)?;
        if member.value.is_null() {
            self.used.mark(member.value);
            return None;
        }
        Some(member)
    }

    /// The first member of several names that is there and not null; all of them count as looked for.
    #[must_use]
    pub fn find_any(&self, names: &[&str]) -> Option<Self> {
        names.iter().find_map(|name| self.find(name))
    }

    /// A member under one of several names.
    ///
    /// # Errors
    /// When none is there.
    pub fn get_any(&self, names: &[&str]) -> Result<Self, Unreadable> {
        self.find_any(names)
            .ok_or_else(|| Unreadable(format!("`{}` has no `{}`", self.path, names.join("` or `"))))
    }

    /// A member, if it is there, also if it is null.
    pub(crate) fn member(&self, name: &str) -> Option<Self> {
        let value = self.value.get(name)?;
        Some(self.part(value, format!("{}.{name}", self.path)))
    }

    /// True if it is null, which uses it.
    #[must_use]
    pub fn is_null(&self) -> bool {
        if self.value.is_null() {
            self.used.mark(self.value);
        }
        self.value.is_null()
    }

    /// A number.
    ///
    /// # Errors
    /// When it is none.
    pub fn number(&self) -> Result<f64, Unreadable> {
        self.used.mark(self.value);
        match self.value {
            Value::Number(number) => number.as_f64().ok_or_else(|| self.unreadable("a number")),
            // JSON has no others.
            Value::String(name) => number_named(name).ok_or_else(|| self.unreadable("a number")),
            _ => Err(self.unreadable("a number")),
        }
    }

    /// A whole number.
    ///
    /// # Errors
    /// When it is none.
    pub fn integer(&self) -> Result<i64, Unreadable> {
        self.used.mark(self.value);
        let whole = self.value.as_f64().filter(|number| number.fract() == 0.0);
        let number = self.value.as_i64().or(whole.map(|number| number as i64));
        number.ok_or_else(|| self.unreadable("a whole number"))
    }

    /// A whole number of 0 or more.
    ///
    /// # Errors
    /// When it is none.
    pub fn count(&self) -> Result<usize, Unreadable> {
        usize::try_from(self.integer()?).map_err(|_| self.unreadable("a number of 0 or more"))
    }

    /// A whole number from 0 to 255.
    ///
    /// # Errors
    /// When it is none.
    pub fn byte(&self) -> Result<u8, Unreadable> {
        u8::try_from(self.integer()?).map_err(|_| self.unreadable("a number from 0 to 255"))
    }

    /// A text.
    ///
    /// # Errors
    /// When it is none.
    pub fn text(&self) -> Result<&'v str, Unreadable> {
        self.used.mark(self.value);
        self.value.as_str().ok_or_else(|| self.unreadable("a text"))
    }

    /// A truth value.
    ///
    /// # Errors
    /// When it is none.
    pub fn truth(&self) -> Result<bool, Unreadable> {
        self.used.mark(self.value);
        match self.value {
            Value::Bool(truth) => Ok(*truth),
            Value::Number(number) => Ok(number.as_f64() != Some(0.0)),
            _ => Err(self.unreadable("true or false")),
        }
    }

    /// The elements of a list.
    ///
    /// # Errors
    /// When it is none.
    pub fn list(&self) -> Result<Vec<Self>, Unreadable> {
        let list = self.value.as_array().ok_or_else(|| self.unreadable("a list"))?;
        self.used.mark(self.value);
        let elements = list.iter().enumerate();
        let element = |(at, value)| self.part(value, format!("{}[{at}]", self.path));
        Ok(elements.map(element).collect())
    }

    /// The members of an object, in the order of their names.
    ///
    /// # Errors
    /// When it is none.
    pub fn members(&self) -> Result<Vec<(&'v str, Self)>, Unreadable> {
        let object = self.value.as_object().ok_or_else(|| self.unreadable("an object"))?;
        self.used.mark(self.value);
        let member = |(name, value): (&'v String, &'v Value)| {
            (name.as_str(), self.part(value, format!("{}.{name}", self.path)))
        };
        Ok(object.iter().map(member).collect())
    }

    /// Reads each element of a list.
    ///
    /// # Errors
    /// When one is not.
    pub fn each<T>(
        &self,
        read: impl Fn(&Self) -> Result<T, Unreadable>,
    ) -> Result<Vec<T>, Unreadable> {
        self.list()?.iter().map(read).collect()
    }

    /// A list of numbers.
    ///
    /// # Errors
    /// When one is none.
    pub fn numbers(&self) -> Result<Vec<f64>, Unreadable> {
        self.each(Self::number)
    }

    /// Reads exactly `N` numbers.
    ///
    /// # Errors
    /// When there are more or fewer.
    pub fn array<const N: usize>(&self) -> Result<[f64; N], Unreadable> {
        let numbers = self.numbers()?;
        numbers.try_into().map_err(|_| self.unreadable(&format!("a list of {N} numbers")))
    }

    /// A pair of counts.
    ///
    /// # Errors
    /// When it is none.
    pub fn cell(&self) -> Result<(usize, usize), Unreadable> {
        match *self.each(Self::count)?.as_slice() {
            [column, row] => Ok((column, row)),
            _ => Err(self.unreadable("a pair of counts")),
        }
    }
}

/// A number that JSON cannot write, by its name.
pub(crate) fn number_named(name: &str) -> Option<f64> {
    match name.to_ascii_lowercase().trim_start_matches('.') {
        "inf" | "+inf" | "infinity" => Some(f64::INFINITY),
        "-inf" | "-infinity" => Some(f64::NEG_INFINITY),
        "nan" => Some(f64::NAN),
        "dbl_max" => Some(f64::MAX),
        _ => None,
    }
}
