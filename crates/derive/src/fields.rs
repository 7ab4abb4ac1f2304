//! Structs: one value per field.

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};
use syn::ext::IdentExt;
use syn::{
    Attribute, DataStruct, Error, Expr, ExprLit, ExprRange, ExprUnary, Field, Ident, Lit, LitStr,
    Meta, RangeLimits, Result, UnOp, Visibility,
};

/// Location of a field's values in the table of the struct.
#[derive(PartialEq)]
enum ValuePlace {
    /// The field is a single value.
    Leaf,
    /// The field's values form a table below its key.
    Table,
    /// The field's values stand next to those of the struct.
    Flat,
}

/// A field, and the contents of its attribute `value`.
struct Declared<'a> {
    field: &'a Field,
    key: String,
    place: ValuePlace,
    range: Option<ExprRange>,
    unit: Option<Expr>,
    example: Option<Expr>,
    choice: Option<Expr>,
    takes: Option<Expr>,
    words: Option<Expr>,
    fixed: bool,
}

/// Generates the list of declarations, and access to each value by the index of its declaration.
pub(crate) fn described(name: &Ident, vis: &Visibility, data: &DataStruct) -> Result<TokenStream> {
    let mut all = Vec::new();
    for field in &data.fields {
        all.extend(declared(field)?);
    }
    let entries = all.iter().map(entry).collect::<Result<Vec<_>>>()?;
    let names: Vec<&Ident> = all.iter().filter_map(|d| d.field.ident.as_ref()).collect();
    if names.len() != all.len() {
        return Err(Error::new_spanned(
            name,
            "a described struct must have named fields",
        ));
    }
    let of = |is_leaf: bool| {
        let of = all.iter().zip(&names).enumerate();
        let of = of.filter(move |(_, (d, _))| (d.place == ValuePlace::Leaf) == is_leaf);
        of.map(|(index, (_, name))| (index, *name))
            .unzip::<_, _, Vec<_>, Vec<_>>()
    };
    let (leaf_at, leaf) = of(true);
    let (below_at, below) = of(false);
    Ok(quote! {
        impl #name {
            /// Declarations of the struct's values.
            #vis const FIELDS: &'static [::cutaway::scene::describe::Field] = &[#(#entries),*];
        }
        impl ::cutaway::scene::describe::Described for #name {
            fn fields(&self) -> &'static [::cutaway::scene::describe::Field] {
                Self::FIELDS
            }
            fn set(&mut self, field: usize, given: ::cutaway::scene::describe::Given) -> bool {
                match field {
                    #(#leaf_at => ::cutaway::scene::describe::Leaf::set(&mut self.#leaf, given),)*
                    _ => false,
                }
            }
            fn get(&self, field: usize) -> Option<::cutaway::scene::describe::Given> {
                match field {
                    #(#leaf_at => ::cutaway::scene::describe::Leaf::get(&self.#leaf),)*
                    _ => None,
                }
            }
            fn below(&self, field: usize) -> Option<&dyn ::cutaway::scene::describe::Described> {
                match field {
                    #(#below_at => Some(&self.#below),)*
                    _ => None,
                }
            }
            fn below_mut(
                &mut self,
                field: usize,
            ) -> Option<&mut dyn ::cutaway::scene::describe::Described> {
                match field {
                    #(#below_at => Some(&mut self.#below),)*
                    _ => None,
                }
            }
        }
    })
}

fn declared(field: &Field) -> Result<Option<Declared<'_>>> {
    let mut of = Declared {
        field,
        key: field
            .ident
            .as_ref()
            .map(|name| name.unraw().to_string())
            .unwrap_or_default(),
        place: ValuePlace::Leaf,
        range: None,
        unit: None,
        example: None,
        choice: None,
        takes: None,
        words: None,
        fixed: false,
    };
    let mut is_hidden = false;
    for attribute in field.attrs.iter().filter(|a| a.path().is_ident("value")) {
        attribute.parse_nested_meta(|meta| {
            let Some(word) = meta.path.get_ident() else {
                return Err(meta.error("unknown word in #[value(..)]"));
            };
            match word.to_string().as_str() {
                "range" => of.range = Some(meta.value()?.parse()?),
                "unit" => of.unit = Some(meta.value()?.parse()?),
                "example" => of.example = Some(meta.value()?.parse()?),
                "choice" => of.choice = Some(meta.value()?.parse()?),
                "takes" => of.takes = Some(meta.value()?.parse()?),
                "words" => of.words = Some(meta.value()?.parse()?),
                "key" => of.key = meta.value()?.parse::<LitStr>()?.value(),
                "fixed" => of.fixed = true,
                "table" => of.place = ValuePlace::Table,
                "flat" => of.place = ValuePlace::Flat,
                "hidden" => is_hidden = true,
                _ => return Err(meta.error("unknown word in #[value(..)]")),
            }
            Ok(())
        })?;
    }
    Ok((!is_hidden).then_some(of))
}

/// The field's declaration, as a `Field` expression.
fn entry(of: &Declared<'_>) -> Result<TokenStream> {
    let ty = &of.field.ty;
    let key = match of.place {
        ValuePlace::Flat => "",
        _ => &of.key,
    };
    let help = help(&of.field.attrs);
    if of.place != ValuePlace::Leaf {
        return Ok(quote! {
            ::cutaway::scene::describe::Field::table(#key, #help, <#ty>::FIELDS)
        });
    }
    let Some(example) = &of.example else {
        return Err(Error::new_spanned(of.field, "a value needs an example"));
    };
    let example = toml(example)?;
    if help.is_empty() {
        return Err(Error::new_spanned(
            of.field,
            "a value needs a doc comment, which is its help",
        ));
    }
    let mut takes = quote! { <#ty as ::cutaway::scene::describe::Leaf>::TYPE };
    if let (Some(range), true) = (&of.range, of.takes.is_some() || of.choice.is_some()) {
        return Err(Error::new_spanned(
            range,
            "a value with `takes` or `choice` cannot have a range",
        ));
    }
    if let Some(range) = &of.range {
        if let (RangeLimits::HalfOpen(_), Some(end)) = (&range.limits, &range.end) {
            return Err(Error::new_spanned(
                end,
                "write ..= before the largest number",
            ));
        }
        let least = range.start.as_ref().map(|e| quote! { #e });
        let least = least.unwrap_or(quote! { f64::NEG_INFINITY });
        let most = range.end.as_ref().map(|e| quote! { #e });
        let most = most.unwrap_or(quote! { f64::INFINITY });
        takes = quote! { #takes.within(#least, #most) };
    }
    if let Some(other) = &of.takes {
        takes = quote! { #other };
    }
    if let Some(choice) = &of.choice {
        takes = quote! { ::cutaway::scene::describe::ValueType::Choice(const { &#choice }) };
    }
    if let Some(words) = &of.words {
        takes = quote! { ::cutaway::scene::describe::ValueType::Or(const { &#takes }, const { &#words }) };
    }
    let unit = of.unit.as_ref().map(|unit| quote! { .unit(#unit) });
    let fixed = of.fixed.then(|| quote! { .fixed() });
    Ok(quote! {
        ::cutaway::scene::describe::Field::leaf(#key, #help, #takes, #example)
            .read_as::<#ty>()#unit #fixed
    })
}

/// Formats an expression as TOML: `[0, -1]`, `"auto"`.
fn toml(expression: &Expr) -> Result<String> {
    Ok(match expression {
        Expr::Lit(literal) => literal.to_token_stream().to_string(),
        Expr::Unary(ExprUnary {
            op: UnOp::Neg(_),
            expr,
            ..
        }) => format!("-{}", toml(expr)?),
        Expr::Array(array) => {
            let all = array.elems.iter().map(toml).collect::<Result<Vec<_>>>()?;
            format!("[{}]", all.join(", "))
        }
        other => {
            let what = "an example must be a number, a text, true, false or a list of them";
            return Err(Error::new_spanned(other, what));
        }
    })
}

/// The first paragraph of a doc comment as help text: in lower case, without the full stop.
fn help(attributes: &[Attribute]) -> String {
    let lines = attributes.iter().filter_map(|a| match &a.meta {
        Meta::NameValue(pair) if pair.path.is_ident("doc") => match &pair.value {
            Expr::Lit(ExprLit {
                lit: Lit::Str(text),
                ..
            }) => Some(text.value().trim().to_owned()),
            _ => None,
        },
        _ => None,
    });
    let lines = lines.skip_while(String::is_empty);
    let first: Vec<String> = lines.take_while(|line| !line.is_empty()).collect();
    let text = first.join(" ");
    let text = match text.strip_suffix('.') {
        Some(sentence) if !sentence.ends_with('.') => sentence,
        _ => &text,
    };
    let mut chars = text.chars();
    let (first, second) = (chars.next(), chars.clone().next());
    match (first, second) {
        // An abbreviation at the beginning keeps its capitals.
        (Some(_), Some(second)) if second.is_uppercase() => text.to_owned(),
        (Some(first), _) => first.to_lowercase().chain(chars).collect(),
        (None, _) => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use syn::{ItemStruct, parse_quote};

    #[test]
    fn examples_are_written_as_toml() {
        for (expression, expected) in [
            (parse_quote!(0.5), "0.5"),
            (parse_quote!([0, -1, 2.5]), "[0, -1, 2.5]"),
            (parse_quote!("a , b - c"), "\"a , b - c\""),
            (parse_quote!([[1, 0], ["50%", 0]]), "[[1, 0], [\"50%\", 0]]"),
            (parse_quote!(true), "true"),
        ] {
            assert_eq!(toml(&expression).expect("an example"), expected);
        }
        assert!(toml(&parse_quote!(f(1))).is_err());
    }

    #[test]
    fn the_first_paragraph_is_the_help() {
        let of: ItemStruct = parse_quote! {
            /// OKLab lightness of
            /// parts.
            ///
            /// More.
            struct A;
        };
        assert_eq!(help(&of.attrs), "OKLab lightness of parts");
        let of: ItemStruct = parse_quote! {
            /// Makes parts: NAME/1, ...
            struct A;
        };
        assert_eq!(help(&of.attrs), "makes parts: NAME/1, ...");
    }

    #[test]
    fn declarations_that_make_no_sense_are_refused() {
        let refused = |of: ItemStruct| {
            let data = DataStruct {
                struct_token: of.struct_token,
                fields: of.fields,
                semi_token: None,
            };
            described(&of.ident, &of.vis, &data).is_err()
        };
        assert!(
            refused(parse_quote! { struct A { #[value(example = 1)] a: f32 } }),
            "no help"
        );
        assert!(
            refused(parse_quote! { struct A { #[doc = "A."] a: f32 } }),
            "no example"
        );
        assert!(
            refused(
                parse_quote! { struct A { #[doc = "A."] #[value(range = 0.0..1.0, example = 1)] a: f32 } }
            ),
            "a range without its end"
        );
        assert!(
            refused(
                parse_quote! { struct A { #[doc = "A."] #[value(rang = 0.0..=1.0, example = 1)] a: f32 } }
            ),
            "a slip"
        );
        assert!(
            !refused(
                parse_quote! { struct A { #[doc = "A."] #[value(range = 0.0..=1.0, example = 1)] a: f32 } }
            ),
            "the control"
        );
    }
}
