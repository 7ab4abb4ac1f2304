//! `#[derive(Described)]`: a struct or an enum of Rust as the declaration of what users set by keys (`cutaway::scene::describe`).
//!
//! Of a struct, each public field is a value: its doc comment is the help, its type the type of the value, and an attribute has the rest:
//!
//! ```ignore
//! /// Opacity of lines.
//! #[value(range = 0.0..=1.0, example = 0.85)]
//! pub alpha: f32,
//! ```
//!
//! | in `#[value(..)]` | is |
//! |---|---|
//! | `range = 0.0..=1.0` | the least and the greatest number; `1.0..` has no greatest |
//! | `unit = "degrees"` | the unit of the numbers |
//! | `example = [0, 1]` | a value, as TOML writes it |
//! | `key = "loop"` | the key, where it is not the name of the field |
//! | `choice = ["a", "b"]` | the words that a text is one of |
//! | `takes = ValueType::File` | the type, where it is not that of the field |
//! | `words = ["auto"]` | words that it may be instead of its type |
//! | `fixed` | no animation moves it |
//! | `table` | the field is described too, and its values lie below its key |
//! | `flat` | the field is described too, and its values lie beside those of the struct |
//! | `hidden` | no value |
//!
//! Of an enum without data, each variant is a word: its name in lower case with dashes, or `#[value(name = "+Y")]`. The derive makes its
//! list `ALL` of words and variants, and `name()`.
//!
//! Cost: of a struct two `match`es over its fields. Cannot: generics, tuple structs, enums with data, which implement the trait by hand.

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
            "a description has no parameters",
        )),
        Data::Struct(data) => fields::described(&input.ident, &input.vis, data),
        Data::Enum(data) => choice::described(&input.ident, &input.vis, data),
        Data::Union(_) => Err(syn::Error::new_spanned(&input, "a union has no values")),
    };
    made.unwrap_or_else(|e| e.to_compile_error()).into()
}
