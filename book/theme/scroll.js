// Makes elements that scroll, and only these, focusable, so that they can be scrolled by keyboard.
(() => {
    const names = { formula: 'formula', 'table-wrapper': 'table' };
    const look = (box) => {
        const scrolls = box.scrollWidth > box.clientWidth + 1;
        const attributes = { tabindex: '0', role: 'group', 'aria-label': (names[box.className] ?? 'code') + ', scrolls' };
        for (const [name, value] of Object.entries(attributes)) {
            if (scrolls) box.setAttribute(name, value);
            else box.removeAttribute(name);
        }
    };
    const observer = new ResizeObserver((entries) => entries.forEach((entry) => look(entry.target)));
    document.querySelectorAll('.formula, .table-wrapper, pre > code').forEach((box) => observer.observe(box));
})();
