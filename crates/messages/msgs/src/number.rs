//! Numbers of any of the kinds that messages have, one or many.

/// One name for each kind, and the enums that hold one, many borrowed, and many owned.
macro_rules! kinds {
    ($($name:ident $rust:ident $text:literal $zero:literal,)*) => {
        /// The kinds of numbers; truth values count as such.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum NumberKind { $(#[doc = $text] $name,)* }

        impl NumberKind {
            /// How messages' texts name it.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self { $(Self::$name => $text,)* }
            }

            /// How many bytes one takes.
            #[must_use]
            pub fn size(self) -> usize {
                match self { $(Self::$name => size_of::<$rust>(),)* }
            }

            /// None of it.
            #[must_use]
            pub fn zero(self) -> Number {
                match self { $(Self::$name => Number::$name($zero),)* }
            }

            /// Many zeros.
            #[must_use]
            pub fn zeros(self, count: usize) -> NumberVec {
                match self { $(Self::$name => NumberVec::$name(vec![$zero; count]),)* }
            }
        }

        /// A number.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum Number { $(#[doc = $text] $name($rust),)* }

        impl Number {
            /// Its kind.
            #[must_use]
            pub fn kind(self) -> NumberKind {
                match self { $(Self::$name(_) => NumberKind::$name,)* }
            }
        }

        /// Many numbers of one kind, borrowed.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum Numbers<'a> { $(#[doc = $text] $name(&'a [$rust]),)* }

        impl Numbers<'_> {
            /// How many.
            #[must_use]
            pub fn len(&self) -> usize {
                match self { $(Self::$name(all) => all.len(),)* }
            }

            /// Whether there are none.
            #[must_use]
            pub fn is_empty(&self) -> bool {
                self.len() == 0
            }

            /// Their kind.
            #[must_use]
            pub fn kind(&self) -> NumberKind {
                match self { $(Self::$name(_) => NumberKind::$name,)* }
            }

            /// One of them.
            #[must_use]
            pub fn get(&self, index: usize) -> Option<Number> {
                match self { $(Self::$name(all) => all.get(index).copied().map(Number::$name),)* }
            }
        }

        /// Room for many numbers of one kind.
        #[derive(Debug, PartialEq)]
        pub enum NumbersMut<'a> { $(#[doc = $text] $name(&'a mut [$rust]),)* }

        impl NumbersMut<'_> {
            /// How many.
            #[must_use]
            pub fn len(&self) -> usize {
                match self { $(Self::$name(all) => all.len(),)* }
            }

            /// Whether there are none.
            #[must_use]
            pub fn is_empty(&self) -> bool {
                self.len() == 0
            }

            /// Their kind.
            #[must_use]
            pub fn kind(&self) -> NumberKind {
                match self { $(Self::$name(_) => NumberKind::$name,)* }
            }

            /// Puts a number of the same kind at a place; others are ignored.
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

        /// Many numbers of one kind.
        #[derive(Clone, Debug, PartialEq)]
        pub enum NumberVec { $(#[doc = $text] $name(Vec<$rust>),)* }

        impl NumberVec {
            /// To be read.
            #[must_use]
            pub fn borrow(&self) -> Numbers<'_> {
                match self { $(Self::$name(all) => Numbers::$name(all),)* }
            }

            /// To be written.
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
                const LEAST_BYTES: usize = size_of::<$rust>();

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
                    // A source gives what it is asked for.
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
