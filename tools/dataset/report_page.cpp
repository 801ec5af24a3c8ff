#include "tools/dataset/report_page.h"

namespace pluvia {

const char* const report_style = R"(
body{max-width:1560px}.filters{display:flex;flex-wrap:wrap;gap:8px 18px;margin:12px 0;align-items:center}
.filters input{width:56px}.charts{display:flex;flex-wrap:wrap;gap:14px}.charts svg{width:370px;height:150px}
.sheet{display:grid;grid-template-columns:repeat(auto-fill,minmax(360px,1fr));gap:16px;margin-top:18px}
.card{font-size:13px}.card .pair{width:100%}.card .slider img{width:100%}.card input[type=range]{margin:2px 0}
.card .lost{color:#b00}
)";

const char* const report_body = R"(
<div class="filters"><label>scene <select id="scene"></select></label><label>camera <select id="camera"></select></label>
<label>split <select id="split"></select></label><label>intensity <select id="intensity"></select></label>
<label>hours <input id="from" type="number" min="0" max="24" step="0.5" value="0"> to
<input id="to" type="number" min="0" max="24" step="0.5" value="24"></label><b id="count"></b></div>
<div class="charts" id="charts"></div><div class="sheet" id="sheet"></div>
)";

const char* const report_script = R"(
const $=id=>document.getElementById(id),all='all';
const choices={scene:f=>[f.scene],camera:f=>[f.camera],split:f=>[f.split],intensity:f=>f.pairs.map(p=>p.intensity)};
for(const id in choices){const values=[...new Set(DATA.frames.flatMap(choices[id]))];
  if(id=='intensity')values.sort((a,b)=>a-b);
  for(const v of [all,...values]){const o=document.createElement('option');o.value=v;
    o.textContent=id=='intensity'&&v!=all?v+' mm/h':v;$(id).append(o)}}
function chosen(){const is=(id,v)=>$(id).value==all||$(id).value==String(v);
  return DATA.frames.filter(f=>is('scene',f.scene)&&is('camera',f.camera)&&is('split',f.split)&&
    f.hour>=+$('from').value&&f.hour<=+$('to').value)
    .map(f=>({f,pairs:f.pairs.filter(p=>is('intensity',p.intensity))})).filter(x=>x.pairs.length)}
function chart(title,bins,low,high){const w=370,h=110,most=Math.max(1e-30,...bins),n=bins.length;
  const bars=bins.map((b,i)=>`<rect x="${i*w/n}" y="${h-h*b/most}" width="${Math.max(1,w/n-1)}" height="${h*b/most}" fill="#1f77b4"/>`);
  return `<div><h3>${title}</h3><svg viewBox="0 0 ${w} ${h+18}">${bars.join('')}<text x="2" y="${h+14}" font-size="12">${low}</text>`+
    `<text x="${w-2}" y="${h+14}" font-size="12" text-anchor="end">${high}</text></svg></div>`}
const sum=lists=>lists.length?lists[0].map((_,i)=>lists.reduce((s,l)=>s+l[i],0)):[0];
function bins(values,n,low,high){const b=Array(n).fill(0);
  for(const v of values)b[Math.min(n-1,Math.max(0,Math.floor((v-low)/(high-low)*n)))]++;return b}
function show(){const list=chosen(),pairs=list.flatMap(x=>x.pairs);
  $('count').textContent=`${list.length} frames, ${pairs.length} pairs`;
  const most=Math.max(1e-6,...DATA.frames.flatMap(f=>f.pairs.map(p=>p.coverage)));
  $('charts').innerHTML=chart('depth, logarithmic, pixels',sum(list.map(x=>x.f.depth)),'0.5 m','810 m')+
    chart('coverage by streaks, pairs',bins(pairs.map(p=>p.coverage),32,0,most),'0',(100*most).toPrecision(3)+' %')+
    chart('hour, frames',bins(list.map(x=>x.f.hour),24,0,24),'0','24')+
    chart('brightness of rainy pictures, pixels',sum(pairs.map(p=>p.brightness)),'black','white');
  const sheet=$('sheet');sheet.innerHTML='';
  for(const {f,pairs} of list){const p=pairs[pairs.length-1];if(!f.clean)continue;
    const card=document.createElement('div');card.className='card';
    card.innerHTML=`<div class="pair"><div class="slider"><img alt="rainy" src="${p.rainy}"><img alt="clean" class="over" src="${f.clean}">`+
      `<span class="line"></span><b style="left:8px">clean</b><b style="right:8px">${p.intensity} mm/h</b></div>`+
      `<input type="range" min="0" max="100" step="0.1" value="50" aria-label="clean to the left, rainy to the right"></div>`+
      `${f.id} &middot; ${f.split} &middot; ${f.hour.toFixed(2)} h &middot; ${f.wind} &middot; EV ${f.ev.toFixed(1)}`;
    sheet.append(card)}
  bind()}
for(const id of ['scene','camera','split','intensity','from','to'])$(id).addEventListener('input',show);
show();
)";

}  // namespace pluvia
