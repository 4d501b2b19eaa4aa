// Studies of the database: a chart whose points open their scenes, rows a screen at a time, the report.
import { draw } from './chart.js';

const many = 5000;  // points

export class Studies {
  constructor(by, made, ask, open, notice) {
    Object.assign(this, { by, made, ask, open, notice, offset: 0, sort: '', list: [], current: '', charts_asked: 0, rows_asked: 0 });
    for (const id of ['study-x', 'study-y', 'study-family', 'study-where'])
      by(id).addEventListener('change', () => { this.offset = 0; this.refresh(); });
    by('study').addEventListener('change', () => this.choose(by('study').value));
    by('earlier').addEventListener('click', () => this.turn(-100));
    by('later').addEventListener('click', () => this.turn(100));
    by('report').addEventListener('click', () => {
      by('report-frame').hidden = false;
      by('report-frame').src = 'report?study=' + encodeURIComponent(by('study').value);
    });
  }

  async show(name) {
    const found = await this.ask('studies');
    this.list = [...found.studies, ...found.fits.map((fit) => ({ name: fit.name, fit: true, axes: [], status: fit.status }))];
    this.by('no-studies').hidden = this.list.length > 0;
    const before = name ?? this.by('study').value;
    this.by('study').replaceChildren(...this.list.map((study) => this.made('option', { value: study.name, textContent: study.name + (study.fit ? ' (fit)' : '') })));
    if (this.list.length === 0) return;
    this.by('study').value = this.list.some((study) => study.name === before) ? before : this.list[0].name;
    await this.choose(this.by('study').value);
  }

  async choose(name) {
    const study = this.list.find((one) => one.name === name);
    this.offset = 0;
    this.sort = '';
    if (name !== this.current) this.by('study-where').value = '';
    this.current = name;
    this.by('report-frame').hidden = true;
    for (const id of ['study-x', 'study-family'])
      this.by(id).replaceChildren(this.made('option', { value: '', textContent: 'as the study says' }), ...study.axes.map((key) => this.made('option', { value: key, textContent: key })));
    if (this.by('study-y').options.length === 0)
      this.by('study-y').append(this.made('option', { value: '', textContent: 'as the study says' }), ...[...document.querySelectorAll('#curve-y option')].map((option) => option.cloneNode(true)));
    this.by('study-state').textContent = study.fit ? 'A fit, ' + study.status + ': its report has data, residuals and intervals.'
      : study.answered + ' of ' + study.points + ' points are answered, ' + study.failed + ' of them without a solution.' + (study.note ? ' ' + study.note : '');
    if (study.fit) {
      this.by('study-chart').replaceChildren();
      this.by('rows').tBodies[0].replaceChildren();
    } else {
      if (study.points > many && study.axes.length > 1) await this.fix_axes(study);
      await this.refresh();
    }
  }

  // Of a large study the axes but the last are fixed at first: nobody can tell its curves apart.
  async fix_axes(study) {
    const found = await this.ask('rows?' + this.question({ limit: 1, columns: study.axes.join(',') }, []));
    const first = study.axes.slice(0, -1).map((key) => {
      const place = found.keys.indexOf(key), unit = /\[(.*)\]$/.exec(found.columns[place]);
      return key + ' = ' + found.rows[0][place] + (unit ? ' ' + unit[1] : '');
    });
    if (this.by('study-where').value === '') this.by('study-where').value = first.join('; ');
  }

  question(more = {}, filters = []) {
    const where = [...this.by('study-where').value.split(';'), ...filters].map((line) => line.trim()).join('\n');
    return new URLSearchParams({ study: this.by('study').value, where, ...more }).toString();
  }

  // What a newer question overtakes is not shown.
  async refresh() {
    const mine = ++this.charts_asked;
    try {
      const chart = await this.ask('chart?' + this.question({ x: this.by('study-x').value, y: this.by('study-y').value, family: this.by('study-family').value }));
      if (mine !== this.charts_asked) return;
      draw(this.by('study-chart'), chart, { height: 340, words: chart.title, chosen: (curve, point) => this.open_point(chart, curve, point) });
      this.notice('');
    } catch (error) {
      if (mine !== this.charts_asked) return;
      this.by('study-chart').replaceChildren();
      this.notice(error.message);
    }
    await this.rows();
  }

  // The scene of a mark, where its x and the family of its curve tell it.
  async open_point(chart, curve, point) {
    const { x, families } = chart.keys, one = chart.curves[curve];
    const where = [x + '=' + one.points[point][0].toPrecision(6) + ' ' + (chart.x.unit === '1' ? '' : chart.x.unit)];
    if (families.length === 1) where.push(families[0] + '=' + one.label);
    try {
      const { rows } = await this.ask('rows?' + this.question({ limit: 2 }, where));
      if (rows.length === 1) this.open((await this.ask('point?id=' + rows[0][0])).scene);
      else this.notice((rows.length ? 'Several rows have' : 'No row has') + ' ' + where.join(' and ') + ': open it from the rows below.');
    } catch (error) { this.notice(error.message); }
  }

  turn(step) {
    this.offset = Math.max(0, this.offset + step);
    return this.rows();
  }

  async rows() {
    let found;
    const mine = ++this.rows_asked;
    try {
      found = await this.ask('rows?' + this.question({ offset: this.offset, limit: 100, sort: this.sort }));
    } catch (error) { return this.notice(error.message); }
    if (mine !== this.rows_asked) return;
    const place = found.rows.length ? found.offset + 1 + ' to ' + (found.offset + found.rows.length) : 'none', asked = this.question();
    this.by('rows-place').textContent = place;
    this.by('earlier').disabled = this.offset === 0;
    this.by('later').disabled = found.rows.length < 100;
    this.ask('count?' + asked).then(({ all }) => {
      if (asked === this.question() && this.by('rows-place').textContent === place) this.by('rows-place').textContent = place + ' of ' + all;
    }).catch((error) => this.notice(error.message));
    const heads = found.columns.map((name, n) => {
      const key = found.keys[n], button = this.made('button', { type: 'button', textContent: name });
      const head = this.made('th', { scope: 'col' }, button);
      if (this.sort === key) head.ariaSort = 'ascending';
      if (this.sort === '-' + key) head.ariaSort = 'descending';
      button.addEventListener('click', () => { this.sort = this.sort === key ? '-' + key : key; this.offset = 0; this.rows(); });
      return head;
    });
    this.by('rows').tHead.replaceChildren(this.made('tr', {}, ...heads, this.made('th', { scope: 'col', textContent: 'scene' })));
    this.by('rows').tBodies[0].replaceChildren(...found.rows.map((row) => {
      const open = this.made('button', { type: 'button', textContent: 'Open' });
      open.setAttribute('aria-label', 'Open the scene of row ' + row[0]);
      open.addEventListener('click', async () => this.open((await this.ask('point?id=' + row[0])).scene));
      return this.made('tr', {}, ...row.map((cell) => this.made('td', { className: typeof cell === 'number' ? 'number' : '', textContent: cell ?? '–' })), this.made('td', {}, open));
    }));
  }
}
