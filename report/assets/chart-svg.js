// Writes what a chart shows right now as SVG: curves, marks, axes, names.
(() => {
  const escape = (text) => String(text).replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;').replaceAll('"', '&quot;');
  const round = (x) => Math.round(x * 10) / 10;

  const steps = (low, high, wanted) => {
    const rough = (high - low) / wanted;
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].map((k) => k * power).find((k) => k >= rough);
    const all = [];
    for (let k = Math.ceil(low / step); k <= Math.floor(high / step) && all.length < 60; k++) all.push(k * step);
    return all;
  };

  rigproof.chartSvg = (plot, spec) => {
    const [width, height, left, right, top, bottom] = [900, spec.height + 40, 84, 18, 44, 52];
    const { x, y } = plot.scales;
    const at = (scale, value, low, high) => low + ((value - scale.min) / (scale.max - scale.min)) * (high - low);
    const px = (value) => round(at(x, value, left, width - right));
    const py = (value) => {
      if (!spec.log_y) return round(at(y, value, height - bottom, top));
      const [low, high, own] = [y.min, y.max, Math.max(value, y.min)].map(Math.log10);
      return round(at({ min: low, max: high }, own, height - bottom, top));
    };
    const powers = () => Array.from({ length: 25 }, (_, k) => 10 ** (k - 12)).filter((own) => own >= y.min && own <= y.max);
    const { colour, digits } = rigproof;
    const text = (tx, ty, words, more = '') => `<text x="${tx}" y="${ty}" fill="${colour('ink')}" ${more}>${escape(words)}</text>`;
    const out = [];
    const clip = `<clipPath id="inside"><rect x="${left}" y="${top}" width="${width - left - right}" height="${height - top - bottom}"/></clipPath>`;
    for (const value of steps(x.min, x.max, 8)) {
      out.push(`<path d="M${px(value)} ${top}V${height - bottom}" stroke="${colour('line')}"/>`, text(px(value), height - bottom + 17, digits(value, 5), 'text-anchor="middle"'));
    }
    for (const value of spec.log_y ? powers() : steps(y.min, y.max, 5)) {
      out.push(`<path d="M${left} ${py(value)}H${width - right}" stroke="${colour('line')}"/>`, text(left - 7, py(value) + 4, digits(value, 4), 'text-anchor="end"'));
    }
    const inside = [];
    for (const span of spec.spans) {
      inside.push(`<rect x="${px(span.from)}" y="${top}" width="${Math.max(px(span.to) - px(span.from), 1)}" height="${height - top - bottom}" fill="${colour(span.role)}"/>`);
    }
    if (spec.band) inside.push(`<rect x="${left}" y="${py(spec.band[1])}" width="${width - left - right}" height="${py(spec.band[0]) - py(spec.band[1])}" fill="${colour('noise')}" opacity="0.22"/>`);
    for (const own of spec.series) inside.push(own.kind === 'bars' ? bars(own) : curve(own));
    function curve(own) {
      let path = '';
      let pen = 'M';
      own.v.forEach((value, k) => {
        if (value === null) { pen = 'M'; return; }
        path += `${pen}${px(spec.t[k])} ${py(value)}`;
        pen = 'L';
      });
      return `<path d="${path}" fill="none" stroke="${colour(own.role)}" stroke-width="${own.width}"${own.dashed ? ' stroke-dasharray="7 4"' : ''}/>`;
    }
    function bars(own) {
      const wide = spec.t.length > 1 ? 0.46 * (spec.t[1] - spec.t[0]) : 0.5;
      const bar = (value, k) => (value === null ? '' : `M${px(spec.t[k] - wide)} ${py(0)}V${py(value)}H${px(spec.t[k] + wide)}V${py(0)}Z`);
      return `<path d="${own.v.map(bar).join('')}" fill="${colour(own.role)}" fill-opacity="0.33" stroke="${colour(own.role)}"/>`;
    }
    const axis = (own) => (own.unit && own.unit !== '1' ? `${own.label} (${own.unit})` : own.label);
    const middle = (top + height - bottom) / 2;
    let from = left;
    const names = spec.series.map((own) => {
      const entry = `<path d="M${from} 30h22" stroke="${colour(own.role)}" stroke-width="3"${own.dashed ? ' stroke-dasharray="7 4"' : ''}/>${text(from + 28, 34, own.name)}`;
      from += 60 + 7 * own.name.length;
      return entry;
    });
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" font-family="sans-serif" font-size="12">`
      + `<title>${escape(spec.title)}</title><defs>${clip}</defs><rect width="${width}" height="${height}" fill="${colour('card')}"/>`
      + text(left, 16, spec.title, 'font-weight="bold" font-size="14"') + names.join('') + out.join('')
      + `<g clip-path="url(#inside)">${inside.join('')}</g>`
      + text((left + width - right) / 2, height - 12, axis(spec.x), 'text-anchor="middle"')
      + text(16, middle, axis(spec.y), `text-anchor="middle" transform="rotate(-90 16 ${middle})"`) + '</svg>';
  };
})();
