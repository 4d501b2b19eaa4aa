#include "core/convolution/influence_terms.hpp"

namespace rollres {

template <class Real>
void InfluenceTerms<Real>::multiply(const WavenumberBlock<Real>& block, bool lateral) const {
  const std::size_t first = block.first;
  const Real *const wwr = ww.re.data() + first, *const wwi = ww.im.data() + first;
  const Real *const wxr = wx.re.data() + first, *const wxi = wx.im.data() + first;
  const Real *const xwr = xw.re.data() + first, *const xwi = xw.im.data() + first;
  const Real *const xxr = xx.re.data() + first, *const xxi = xx.im.data() + first;
  if (!lateral) {
#pragma GCC ivdep
    for (int i = 0; i < block.count; ++i) {
      const Real pr = block.even_re[i], pi = block.even_im[i], xr = block.second_re[i], xi = block.second_im[i];
      block.even_re[i] = -(wwr[i] * pr - wwi[i] * pi) - (wxr[i] * xr - wxi[i] * xi);
      block.even_im[i] = -(wwr[i] * pi + wwi[i] * pr) - (wxr[i] * xi + wxi[i] * xr);
      block.second_re[i] = -(xwr[i] * pr - xwi[i] * pi) + (xxr[i] * xr - xxi[i] * xi);
      block.second_im[i] = -(xwr[i] * pi + xwi[i] * pr) + (xxr[i] * xi + xxi[i] * xr);
    }
    return;
  }
  const Real *const wyr = wy.re.data() + first, *const wyi = wy.im.data() + first;
  const Real *const ywr = yw.re.data() + first, *const ywi = yw.im.data() + first;
  const Real *const xyr = xy.re.data() + first, *const xyi = xy.im.data() + first;
  const Real *const yyr = yy.re.data() + first, *const yyi = yy.im.data() + first;
#pragma GCC ivdep
  for (int i = 0; i < block.count; ++i) {
    const Real pr = block.even_re[i], pi = block.even_im[i], xr = block.second_re[i], xi = block.second_im[i];
    const Real yr = block.odd_re[i], yi = block.odd_im[i];
    block.even_re[i] = -(wwr[i] * pr - wwi[i] * pi) - (wxr[i] * xr - wxi[i] * xi) - (wyr[i] * yr - wyi[i] * yi);
    block.even_im[i] = -(wwr[i] * pi + wwi[i] * pr) - (wxr[i] * xi + wxi[i] * xr) - (wyr[i] * yi + wyi[i] * yr);
    block.second_re[i] = -(xwr[i] * pr - xwi[i] * pi) + (xxr[i] * xr - xxi[i] * xi) + (xyr[i] * yr - xyi[i] * yi);
    block.second_im[i] = -(xwr[i] * pi + xwi[i] * pr) + (xxr[i] * xi + xxi[i] * xr) + (xyr[i] * yi + xyi[i] * yr);
    block.odd_re[i] = -(ywr[i] * pr - ywi[i] * pi) + (xyr[i] * xr - xyi[i] * xi) + (yyr[i] * yr - yyi[i] * yi);
    block.odd_im[i] = -(ywr[i] * pi + ywi[i] * pr) + (xyr[i] * xi + xyi[i] * xr) + (yyr[i] * yi + yyi[i] * yr);
  }
}

template struct InfluenceTerms<double>;
template struct InfluenceTerms<float>;

}  // namespace rollres
