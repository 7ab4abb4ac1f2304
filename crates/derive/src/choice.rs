//! Enums: one word per variant.

use proc_macro2::TokenStream;
use quote::quote;
use syn::{DataEnum, Error, Fields, Ident, LitStr, Result, Variant, Visibility};

/// Generates the list of words, and the trait implementation that lets the enum be the value of a key.
pub(crate) fn described(name: &Ident, vis: &Visibility, data: &DataEnum) -> Result<TokenStream> {
    let with_data = data
        .variants
        .iter()
        .find(|v| !matches!(v.fields, Fields::Unit));
    if let Some(variant) = with_data {
        return Err(Error::new_spanned(
            variant,
            "a variant of a described enum must not have data",
        ));
    }
    let variants: Vec<&Ident> = data.variants.iter().map(|v| &v.ident).collect();
    let words = data.variants.iter().map(word_of);
    let words = words.collect::<Result<Vec<String>>>()?;
    let count = variants.len();
    Ok(quote! {
        impl #name {
            /// All variants with their names.
            #vis const ALL: [(&'static str, Self); #count] = [#((#words, Self::#variants)),*];

            /// Name in documents and options.
            #vis const fn name(self) -> &'static str {
                match self {
                    #(Self::#variants => #words,)*
                }
            }

            /// The variant with a given name.
            #vis fn named(name: &str) -> Option<Self> {
                Self::ALL.iter().find(|(known, _)| *known == name).map(|(_, one)| *one)
            }
        }
        impl ::cutaway::scene::describe::Leaf for #name {
            const TYPE: ::cutaway::scene::describe::ValueType =
                ::cutaway::scene::describe::ValueType::Choice(&[#(#words),*]);
            fn of(given: ::cutaway::scene::describe::Given) -> Option<Self> {
                match given {
                    ::cutaway::scene::describe::Given::Text(word) => Self::named(&word),
                    _ => None,
                }
            }
            fn get(&self) -> Option<::cutaway::scene::describe::Given> {
                Some(::cutaway::scene::describe::Given::Text(self.name().to_owned()))
            }
        }
    })
}

/// The word for a variant.
fn word_of(variant: &Variant) -> Result<String> {
    let mut given = None;
    for attribute in variant.attrs.iter().filter(|a| a.path().is_ident("value")) {
        attribute.parse_nested_meta(|meta| {
            if !meta.path.is_ident("name") {
                return Err(meta.error("the only attribute of a variant is `name`"));
            }
            given = Some(meta.value()?.parse::<LitStr>()?.value());
            Ok(())
        })?;
    }
    Ok(given.unwrap_or_else(|| word(&variant.ident.to_string())))
}

/// Converts `EvenOdd` to `even-odd`.
fn word(variant: &str) -> String {
    let mut word = String::new();
    for c in variant.chars() {
        if c.is_uppercase() && !word.is_empty() {
            word.push('-');
        }
        word.extend(c.to_lowercase());
    }
    word
}

#[cfg(test)]
mod tests {
    use super::word;

    #[test]
    fn variants_become_words() {
        for (variant, expected) in [("None", "none"), ("EvenOdd", "even-odd"), ("A", "a")] {
            assert_eq!(word(variant), expected);
        }
    }
}
