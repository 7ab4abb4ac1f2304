// Interactive features of the page: sorting tables, copying commands, highlighting a chart's series, and comparing pictures with a slider.
// Without this script, all content can still be read. The script fetches nothing and stores nothing.
"use strict";
(() => {
  const make = (tag, properties = {}, ...children) => {
    const element = Object.assign(document.createElement(tag), properties);
    element.append(...children);
    return element;
  };

  for (const table of document.querySelectorAll("table.grid")) {
    const heads = [...table.tHead.rows[0].cells];
    heads.forEach((head, column) => {
      const button = make("button", { type: "button", title: "sort by this column" });
      button.append(...head.childNodes);
      head.append(button);
      button.addEventListener("click", () => {
        const rising = head.getAttribute("aria-sort") !== "ascending";
        heads.forEach((h) => h.removeAttribute("aria-sort"));
        head.setAttribute("aria-sort", rising ? "ascending" : "descending");
        const key = (row) => {
          const cell = row.cells[column];
          return cell.dataset.key === undefined ? cell.textContent : Number(cell.dataset.key);
        };
        // Numbers come before words in both sort orders.
        const compare = (a, b) => {
          const [x, y] = [key(a), key(b)];
          if (typeof x !== typeof y) return typeof x === "number" ? -1 : 1;
          const order = typeof x === "number" ? x - y : x.localeCompare(y, "en", { numeric: true });
          return rising ? order : -order;
        };
        const body = table.tBodies[0];
        body.append(...[...body.rows].sort(compare));
      });
    });
  }

  for (const command of document.querySelectorAll(".command")) {
    const text = command.querySelector("pre");
    const button = make("button", { type: "button", textContent: "copy" });
    button.addEventListener("click", async () => {
      try {
        await navigator.clipboard.writeText(text.textContent);
        button.textContent = "copied";
      } catch {
        // If the clipboard is not accessible, the text is selected, so that it can be copied with the keyboard.
        getSelection().selectAllChildren(text);
        button.textContent = "selected";
      }
      setTimeout(() => { button.textContent = "copy"; }, 1500);
    });
    command.append(button);
  }

  for (const chart of document.querySelectorAll(".chart")) {
    const series = [...chart.querySelectorAll("[data-series]")];
    for (const item of series) {
      const single = (on) => {
        chart.classList.toggle("picked", on);
        for (const other of series) {
          other.classList.toggle("chosen", on && other.dataset.series === item.dataset.series);
        }
      };
      item.addEventListener("pointerenter", () => single(true));
      item.addEventListener("pointerleave", () => single(false));
    }
  }

  for (const gallery of document.querySelectorAll(".gallery")) {
    const shots = [...gallery.querySelectorAll(".shots figure")];
    if (shots.length < 2) continue;
    const name = (shot) => shot.querySelector("b").textContent;
    const pick = (label, chosen) => {
      const select = make("select");
      shots.forEach((shot, i) => select.append(make("option", { value: String(i), textContent: name(shot) })));
      select.value = chosen;
      return [make("label", {}, `${label} `, select), select];
    };
    const [leftLabel, left] = pick("left", gallery.dataset.left);
    const [rightLabel, right] = pick("right", gallery.dataset.right);
    const under = make("img", { className: "under" });
    const over = make("img", { className: "over" });
    const range = make("input", { type: "range", min: "0", max: "100", step: "0.5", value: "50" });
    range.setAttribute("aria-label", "where the left picture ends, in percent");
    const compare = make("div", { className: "compare" }, under, over, range, make("div", { className: "line" }));
    const errors = gallery.querySelector(".switch .errors");
    const show = () => {
      for (const [image, select] of [[over, left], [under, right]]) {
        const shot = shots[Number(select.value)];
        const wrong = errors?.checked ? shot.querySelector("img.errors") : null;
        image.src = (wrong ?? shot.querySelector("img")).src;
        image.alt = name(shot);
      }
    };
    left.addEventListener("change", show);
    right.addEventListener("change", show);
    gallery.querySelectorAll(".switch input").forEach((radio) => radio.addEventListener("change", show));
    range.addEventListener("input", () => compare.style.setProperty("--at", `${range.value}%`));
    shots.forEach((shot, i) => {
      for (const image of shot.querySelectorAll("img")) {
        image.title = "click: to the right; with shift: to the left";
        image.addEventListener("click", (event) => {
          (event.shiftKey ? left : right).value = String(i);
          show();
        });
      }
    });
    gallery.classList.add("live");
    const switched = gallery.querySelector(".switch");
    const picks = make("div", { className: "picks" }, leftLabel, rightLabel);
    (switched ?? gallery.firstElementChild)[switched ? "after" : "before"](picks, compare);
    // A report has hundreds of pictures, so they are decoded only when they come into view.
    new IntersectionObserver((entries, observer) => {
      if (entries.some((e) => e.isIntersecting)) {
        observer.disconnect();
        show();
      }
    }, { rootMargin: "600px" }).observe(gallery);
  }
})();
