//! Numbers of all types in messages, single or many.

/// Declares the number types, and the enums of one, many borrowed, and many owned numbers.
macro_rules! kinds {
    ($($name:ident $rust:ident $text:literal $zero:literal,)*) => {
        /// Number types; booleans are included.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum NumberKind { $(#[doc = $text] $name,)* }

        impl NumberKind {
            /// Name in interface texts.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self { $(Self::$name => $text,)* }
            }

            /// Size of one number [bytes].
            #[must_use]
            pub fn size(self) -> usize {
                match self { $(Self::$name => size_of::<$rust>(),)* }
            }

            /// Zero.
            #[must_use]
            pub fn zero(self) -> Number {
                match self { $(Self::$name => Number::$name($zero),)* }
            }

            /// Vector of zeros.
            #[must_use]
            pub fn zeros(self, count: usize) -> NumberVec {
                match self { $(Self::$name => NumberVec::$name(vec![$zero; count]),)* }
            }
        }

        /// Single number.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum Number { $(#[doc = $text] $name($rust),)* }

        impl Number {
            /// Type of the number.
            #[must_use]
            pub fn kind(self) -> NumberKind {
                match self { $(Self::$name(_) => NumberKind::$name,)* }
            }
        }

        /// Borrowed numbers of one type.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum Numbers<'a> { $(#[doc = $text] $name(&'a [$rust]),)* }

        impl Numbers<'_> {
            /// Number of elements.
            #[must_use]
            pub fn len(&self) -> usize {
                match self { $(Self::$name(all) => all.len(),)* }
            }

            /// Returns true if there are none.
            #[must_use]
            pub fn is_empty(&self) -> bool {
                self.len() == 0
            }

            /// Type of the numbers.
            #[must_use]
            pub fn kind(&self) -> NumberKind {
                match self { $(Self::$name(_) => NumberKind::$name,)* }
            }

            /// Element at an index.
            #[must_use]
            pub fn get(&self, index: usize) -> Option<Number> {
                match self { $(Self::$name(all) => all.get(index).copied().map(Number::$name),)* }
            }
        }

        /// Mutable borrowed numbers of one type.
        #[derive(Debug, PartialEq)]
        pub enum NumbersMut<'a> { $(#[doc = $text] $name(&'a mut [$rust]),)* }

        impl NumbersMut<'_> {
            /// Number of elements.
            #[must_use]
            pub fn len(&self) -> usize {
                match self { $(Self::$name(all) => all.len(),)* }
            }

            /// Returns true if there are none.
            #[must_use]
            pub fn is_empty(&self) -> bool {
                self.len() == 0
            }

            /// Type of the numbers.
            #[must_use]
            pub fn kind(&self) -> NumberKind {
                match self { $(Self::$name(_) => NumberKind::$name,)* }
            }

            /// Sets an element to a number of the same type; other types are ignored.
            pub fn set(&mut self, index: usize, number: Number) {
                match (self, number) {
                    $((Self::$name(all), Number::$name(number)) => {
                        if let Some(place) = all.get_mut(index) {
                            *place = number;
                        }
                    })*
                    _ => {}
                }
            }
        }

        /// Vector of numbers of one type.
        #[derive(Clone, Debug, PartialEq)]
        pub enum NumberVec { $(#[doc = $text] $name(Vec<$rust>),)* }

        impl NumberVec {
            /// Borrows the numbers.
            #[must_use]
            pub fn borrow(&self) -> Numbers<'_> {
                match self { $(Self::$name(all) => Numbers::$name(all),)* }
            }

            /// Borrows the numbers mutably.
            #[must_use]
            pub fn borrow_mut(&mut self) -> NumbersMut<'_> {
                match self { $(Self::$name(all) => NumbersMut::$name(all),)* }
            }
        }

        $(
            impl From<$rust> for Number {
                fn from(number: $rust) -> Self {
                    Self::$name(number)
                }
            }

            impl crate::codec::Codec for $rust {
                const MIN_BYTES: usize = size_of::<$rust>();

                fn blank() -> Self {
                    $zero
                }

                fn write(&self, sink: &mut dyn crate::Sink, _: Option<u32>) {
                    sink.number(Number::$name(*self));
                }

                fn read(
                    &mut self,
                    source: &mut dyn crate::Source,
                    _: Option<u32>,
                ) -> Result<(), crate::DecodeError> {
                    // A source returns the requested type.
                    if let Number::$name(number) = source.number(NumberKind::$name)? {
                        *self = number;
                    }
                    Ok(())
                }

                fn write_all(all: &[Self], sink: &mut dyn crate::Sink) {
                    sink.numbers(Numbers::$name(all));
                }

                fn read_all(
                    all: &mut [Self],
                    source: &mut dyn crate::Source,
                ) -> Result<(), crate::DecodeError> {
                    source.numbers(NumbersMut::$name(all))
                }
            }
        )*
    };
}

kinds! {
    Bool bool "bool" false,
    I8 i8 "int8" 0,
    U8 u8 "uint8" 0,
    I16 i16 "int16" 0,
    U16 u16 "uint16" 0,
    I32 i32 "int32" 0,
    U32 u32 "uint32" 0,
    I64 i64 "int64" 0,
    U64 u64 "uint64" 0,
    F32 f32 "float32" 0.0,
    F64 f64 "float64" 0.0,
}
