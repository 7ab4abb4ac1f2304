//! `#[derive(Described)]`: declares the values that users set by keys (`cutaway::scene::describe`) from a Rust struct or enum.
//!
//! In a struct, each public field is a value: its doc comment is the help, its type the type of the value, and an attribute gives the rest:
//!
//! ```ignore
//! /// Opacity of lines.
//! #[value(range = 0.0..=1.0, example = 0.85)]
//! pub alpha: f32,
//! ```
//!
//! | in `#[value(..)]` | is |
//! |---|---|
//! | `range = 0.0..=1.0` | the smallest and the largest number; `1.0..` has no largest |
//! | `unit = "degrees"` | the unit of the numbers |
//! | `example = [0, 1]` | an example value in TOML notation |
//! | `key = "loop"` | the key, if it differs from the field name |
//! | `choice = ["a", "b"]` | the words allowed for a text |
//! | `takes = ValueType::File` | the value type, if it is not that of the field |
//! | `words = ["auto"]` | words allowed instead of a value of the type |
//! | `fixed` | the value cannot be animated |
//! | `table` | the field's type is also described; its values are below its key |
//! | `flat` | the field's type is also described; its values are next to those of the struct |
//! | `hidden` | the field is not a value |
//!
//! In an enum without data, each variant is a word: its name in lower case with dashes, or `#[value(name = "+Y")]`. The derive generates
//! the list `ALL` of words and variants, and `name()`.
//!
//! Cost: two `match`es over the fields of a struct. Not supported: generics, tuple structs, enums with data: implement the trait by hand.

mod choice;
mod fields;

use proc_macro::TokenStream;
use syn::{Data, DeriveInput, parse_macro_input};

/// Declares the values of a struct, or the words of an enum.
#[proc_macro_derive(Described, attributes(value))]
pub fn described(input: TokenStream) -> TokenStream {
    let input = parse_macro_input!(input as DeriveInput);
    let made = match &input.data {
        _ if !input.generics.params.is_empty() => Err(syn::Error::new_spanned(
            &input.generics,
            "a described type must not be generic",
        )),
        Data::Struct(data) => fields::described(&input.ident, &input.vis, data),
        Data::Enum(data) => choice::described(&input.ident, &input.vis, data),
        Data::Union(_) => Err(syn::Error::new_spanned(
            &input,
            "a union cannot be described: use a struct or an enum",
        )),
    };
    made.unwrap_or_else(|e| e.to_compile_error()).into()
}
