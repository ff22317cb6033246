// form.c - public calls on collision meshes.
#include "lib/api/fields.h"
#include "lib/collide/form.h"

hair_result hair_form_create(const hair_form_desc* desc, hair_form** out)
{
    hair_host host = HAIR_HOST_OF(desc);
    hair_form_desc own;
    hair_result result = HAIR_TAKE(&host, hair_form_desc, desc, &own);
    if (result) return result;
    if (!own.positions) return hair_fail(&host, HAIR_ERROR_ARGUMENT, "hair_form_desc.positions is NULL");
    if (!own.triangles) return hair_fail(&host, HAIR_ERROR_ARGUMENT, "hair_form_desc.triangles is NULL");
    if (!out) return hair_fail(&host, HAIR_ERROR_ARGUMENT, "out is NULL");
    return hair_form_build(&host, &own, out);
}

void hair_form_destroy(hair_form* form)
{
    hair_form_release(form);
}

hair_result hair_form_describe(const hair_form* form, hair_form_info* out)
{
    if (!form) return HAIR_ERROR_ARGUMENT;
    return HAIR_GIVE(&form->host, hair_form_info, &form->info, out);
}
