//! JSON that says where it is not as expected.

use std::fmt;

use serde_json::Value;

/// What a case holds that its check does not understand.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unreadable(pub String);

impl fmt::Display for Unreadable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Unreadable {}

/// A value of a case and the way to it.
#[derive(Clone, Debug)]
pub struct Reader<'v> {
    value: &'v Value,
    path: String,
}

impl<'v> Reader<'v> {
    /// A value that is called so.
    #[must_use]
    pub fn new(value: &'v Value, name: &str) -> Self {
        Self { value, path: name.to_owned() }
    }

    /// The value itself.
    #[must_use]
    pub fn value(&self) -> &'v Value {
        self.value
    }

    /// The way to it.
    #[must_use]
    pub fn path(&self) -> &str {
        &self.path
    }

    /// What this value would have to be.
    #[must_use]
    pub fn unreadable(&self, wanted: &str) -> Unreadable {
        let mut shown = self.value.to_string();
        if shown.len() > 60 {
            let end = (0..=57).rev().find(|&end| shown.is_char_boundary(end)).unwrap_or(0);
            shown.truncate(end);
            shown += "...";
        }
        Unreadable(format!("`{}` must be {wanted}; it is {shown}", self.path))
    }

    /// A member that must be there.
    ///
    /// # Errors
    /// When it is not.
    pub fn get(&self, name: &str) -> Result<Self, Unreadable> {
        self.find(name).ok_or_else(|| Unreadable(format!("`{}` has no `{name}`", self.path)))
    }

    /// A member, if it is there and not null.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<Self> {
        let value = self.value.get(name).filter(|value| !value.is_null())?;
        Some(Self { value, path: format!("{}.{name}", self.path) })
    }

    /// Whether it is null.
    #[must_use]
    pub fn is_null(&self) -> bool {
        self.value.is_null()
    }

    /// A number.
    ///
    /// # Errors
    /// When it is none.
    pub fn number(&self) -> Result<f64, Unreadable> {
        match self.value {
            Value::Number(number) => number.as_f64().ok_or_else(|| self.unreadable("a number")),
            // JSON has no others.
            Value::String(name) => match name.to_ascii_lowercase().trim_start_matches('.') {
                "inf" | "+inf" | "infinity" => Ok(f64::INFINITY),
                "-inf" | "-infinity" => Ok(f64::NEG_INFINITY),
                "nan" => Ok(f64::NAN),
                _ => Err(self.unreadable("a number")),
            },
            _ => Err(self.unreadable("a number")),
        }
    }

    /// A whole number.
    ///
    /// # Errors
    /// When it is none.
    pub fn integer(&self) -> Result<i64, Unreadable> {
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
        self.value.as_str().ok_or_else(|| self.unreadable("a text"))
    }

    /// A truth value.
    ///
    /// # Errors
    /// When it is none.
    pub fn truth(&self) -> Result<bool, Unreadable> {
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
        let elements = list.iter().enumerate();
        let element = |(at, value)| Self { value, path: format!("{}[{at}]", self.path) };
        Ok(elements.map(element).collect())
    }

    /// The members of an object, in the order of their names.
    ///
    /// # Errors
    /// When it is none.
    pub fn members(&self) -> Result<Vec<(&'v str, Self)>, Unreadable> {
        let object = self.value.as_object().ok_or_else(|| self.unreadable("an object"))?;
        let member = |(name, value): (&'v String, &'v Value)| {
            (name.as_str(), Self { value, path: format!("{}.{name}", self.path) })
        };
        Ok(object.iter().map(member).collect())
    }

    /// What each element of a list is.
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

    /// So many numbers.
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
