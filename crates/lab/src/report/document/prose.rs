//! Converts Markdown written by people to safe HTML: HTML tags in it become text, images are replaced by their descriptions, and only links
//! to the web work. Alternatively, converts it to Markdown without HTML.

use pulldown_cmark::{Event, HeadingLevel, Options, Parser, Tag, TagEnd, html};

/// The prose as HTML. Its headings are given a low level, as the prose is inside a section.
pub(super) fn prose(text: &str) -> String {
    let events = Parser::new_ext(text, Options::ENABLE_TABLES).filter_map(tame);
    let mut page = String::new();
    html::push_html(&mut page, events);
    page
}

/// The prose unchanged, except that HTML tags in it are escaped as text.
pub(super) fn without_html(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    let mut end = 0;
    for (event, range) in Parser::new_ext(text, Options::ENABLE_TABLES).into_offset_iter() {
        if matches!(event, Event::Html(_) | Event::InlineHtml(_)) {
            escaped.push_str(&text[end..range.start]);
            escaped.push_str(&text[range.clone()].replace('<', "&lt;"));
            end = range.end;
        }
    }
    escaped + &text[end..]
}

fn tame(event: Event<'_>) -> Option<Event<'_>> {
    let level = HeadingLevel::H5;
    Some(match event {
        Event::Html(text) | Event::InlineHtml(text) => Event::Text(text),
        Event::Start(Tag::Heading { .. }) => Event::Start(Tag::Heading {
            level,
            id: None,
            classes: Vec::new(),
            attrs: Vec::new(),
        }),
        Event::End(TagEnd::Heading(_)) => Event::End(TagEnd::Heading(level)),
        // The alternative text of the image is kept.
        Event::Start(Tag::Image { .. }) | Event::End(TagEnd::Image) => return None,
        Event::Start(Tag::Link {
            link_type,
            dest_url,
            title,
            id,
        }) => {
            let is_web = dest_url.starts_with("https://") || dest_url.starts_with("http://");
            Event::Start(Tag::Link {
                link_type,
                dest_url: if is_web { dest_url } else { "#".into() },
                title,
                id,
            })
        }
        event => event,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tags_in_prose_are_text() {
        assert_eq!(
            without_html("Read *down*: `a<b` <b>x</b>\n\n<script>alert(1)</script>\n\n    1 < 2\n"),
            "Read *down*: `a<b` &lt;b>x&lt;/b>\n\n&lt;script>alert(1)&lt;/script>\n\n    1 < 2\n"
        );
    }

    #[test]
    fn prose_is_set_and_tamed() {
        let page = prose(
            "# Why\n\nOne *two* <script>alert(1)</script> `a<b`\n\n![a cat](http://x/cat.png) [in](javascript:x) [out](https://x/)\n\n| a |\n|---|\n| b |\n",
        );
        for said in [
            "<h5>Why</h5>",
            "<em>two</em>",
            "&lt;script&gt;",
            "<code>a&lt;b</code>",
            "a cat",
            "href=\"#\"",
            "href=\"https://x/\"",
            "<td>b</td>",
        ] {
            assert!(page.contains(said), "{said} is missing from {page}");
        }
        for kept_out in ["<script", "<img", "javascript:"] {
            assert!(!page.contains(kept_out), "{kept_out} is in {page}");
        }
    }
}
